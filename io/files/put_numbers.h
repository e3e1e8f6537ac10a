// SPDX-License-Identifier: MIT
// Numbers as bytes and as text, at the end of a file.
#pragma once

#include <charconv>
#include <type_traits>

#include "io/files/atomic_file.h"
#include "io/files/field_reader.h"

namespace deliso {

// Appends the bytes of a number, the least significant first.
template <class T>
void put_binary(AtomicFile& out, T value) {
  static_assert(std::is_arithmetic_v<T>);
  const auto bytes = little_endian(value);
  out.write({bytes.data(), bytes.size()});
}

// Appends the shortest text that reads back as `value`, then `after`.
template <class Out, class T>
void put_text(Out& out, T value, char after) {
  char text[32];
  char* end = std::to_chars(text, text + sizeof text - 1, value).ptr;
  *end++ = after;
  out.write({text, static_cast<std::size_t>(end - text)});
}

}  // namespace deliso
