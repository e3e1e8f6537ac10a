// SPDX-License-Identifier: MIT
// Numbers and their bytes, in either byte order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>

namespace deliso {

// The order that is not this machine's.
inline constexpr std::endian kSwappedOrder =
    std::endian::native == std::endian::little ? std::endian::big : std::endian::little;

// Returns the bytes of a number, the least significant first.
template <class T>
std::array<char, sizeof(T)> little_endian(const T& number) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(number);
  if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
  return bytes;
}

// Reads numbers by their offsets.
class FieldReader {
 public:
  FieldReader(std::span<const std::byte> bytes, std::endian order)
      : bytes_(bytes), swapped_(order != std::endian::native) {}
  FieldReader(std::string_view bytes, std::endian order)
      : FieldReader(std::as_bytes(std::span(bytes)), order) {}

  // pre: the bytes reach as far.
  template <class T>
  T get(std::size_t offset) const {
    std::array<std::byte, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes_.data() + offset, sizeof(T));
    if (swapped_) std::ranges::reverse(raw);
    return std::bit_cast<T>(raw);
  }

 private:
  std::span<const std::byte> bytes_;
  bool swapped_;
};

}  // namespace deliso
