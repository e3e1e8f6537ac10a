// SPDX-License-Identifier: MIT
// Numbers of a binary header, by their offset, in either byte order.
#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <utility>

namespace deliso {

// The order that is not this machine's.
inline constexpr std::endian kSwappedOrder =
    std::endian::native == std::endian::little ? std::endian::big : std::endian::little;

class FieldReader {
 public:
  FieldReader(std::span<const std::byte> bytes, bool swapped) : bytes_(bytes), swapped_(swapped) {}
  FieldReader(std::span<const std::byte> bytes, std::endian order)
      : FieldReader(bytes, order != std::endian::native) {}

  // pre: the bytes reach as far.
  template <class T>
  T get(std::size_t offset) const {
    std::byte raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + offset, sizeof(T));
    if (swapped_)
      for (std::size_t n = 0; n < sizeof(T) / 2; ++n) std::swap(raw[n], raw[sizeof(T) - 1 - n]);
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

 private:
  std::span<const std::byte> bytes_;
  bool swapped_;
};

}  // namespace deliso
