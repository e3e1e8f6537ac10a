// SPDX-License-Identifier: MIT
// Numbers to bytes and back. A list of members, given to a writer or to a reader, writes what the
// other reads. Numbers are little-endian; a list is the count of its elements and then these.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "io/files/input_file.h"

namespace deliso {

// The bytes of a number as the file has them, or from there: the same change both ways.
template <class N>
void to_little_endian(unsigned char (&bytes)[sizeof(N)]) {
  if constexpr (std::endian::native == std::endian::big) {
    for (std::size_t n = 0; n < sizeof(N) / 2; ++n) {
      std::swap(bytes[n], bytes[sizeof(N) - 1 - n]);
    }
  }
}

class PartWriter {
 public:
  explicit PartWriter(std::string& bytes) : bytes_(bytes) {}

  template <class... N>
  void operator()(const N&... numbers) {
    (put(numbers), ...);
  }
  template <class List, class Pass>
  void list(List& list, Pass&& pass) {
    put(std::uint64_t{list.size()});
    for (auto& element : list) pass(element);
  }

 private:
  template <class N>
  void put(const N& number) {
    static_assert(std::is_trivially_copyable_v<N>);
    unsigned char bytes[sizeof(N)];
    std::memcpy(bytes, &number, sizeof(N));
    to_little_endian<N>(bytes);
    bytes_.append(reinterpret_cast<const char*>(bytes), sizeof(N));
  }

  std::string& bytes_;
};

// Throws InputError, with the part's name, where the bytes end too soon or hold no such number.
class PartReader {
 public:
  PartReader(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  template <class... N>
  void operator()(N&... numbers) {
    (take(numbers), ...);
  }
  // Grows with what is read, so a false count asks for no memory.
  template <class List, class Pass>
  void list(List& list, Pass&& pass) {
    std::uint64_t count = 0;
    take(count);
    if (count > bytes_.size()) fail(name_, "is no sound part: a list is too long");
    for (; count > 0; --count) {
      list.resize(list.size() + 1);
      pass(list.back());
    }
  }
  void end() const {
    if (!bytes_.empty()) fail(name_, "is no sound part: more bytes than it says");
  }

 private:
  template <class N>
  void take(N& number) {
    static_assert(std::is_trivially_copyable_v<N>);
    unsigned char bytes[sizeof(N)];
    if (bytes_.size() < sizeof(N)) fail(name_, "is no sound part: it ends too soon");
    std::memcpy(bytes, bytes_.data(), sizeof(N));
    bytes_.remove_prefix(sizeof(N));
    to_little_endian<N>(bytes);
    if constexpr (std::is_same_v<N, bool>) {
      if (bytes[0] > 1) fail(name_, "is no sound part: a truth value");
    }
    std::memcpy(&number, bytes, sizeof(N));
  }

  std::string_view bytes_;
  std::string_view name_;
};

}  // namespace deliso
