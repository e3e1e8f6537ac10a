// SPDX-License-Identifier: MIT
// Numbers to bytes and back. A list of members, given to a writer or to a reader, writes what the
// other reads. Numbers are little-endian; a list is the count of its elements and then these.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "io/files/field_reader.h"
#include "io/files/input_file.h"

namespace deliso {

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
    const auto bytes = little_endian(number);
    bytes_.append(bytes.data(), bytes.size());
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
    if (bytes_.size() < sizeof(N)) fail(name_, "is no sound part: it ends too soon");
    if constexpr (std::is_same_v<N, bool>) {
      if (static_cast<unsigned char>(bytes_[0]) > 1) fail(name_, "is no sound part: a truth value");
    }
    number = FieldReader(bytes_, std::endian::little).get<N>(0);
    bytes_.remove_prefix(sizeof(N));
  }

  std::string_view bytes_;
  std::string_view name_;
};

}  // namespace deliso
