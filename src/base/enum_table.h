// SPDX-License-Identifier: MIT
// Tables of enumerations: all that is said of a value stands in one row, which begins with the
// value. A row that is missing or out of place does not compile.
#pragma once

#include <array>
#include <cstddef>

namespace deliso {

template <class Enum, class Words>
struct EnumRow {
  Enum value;
  Words words;
};

// True if the rows have the values 0, 1, 2 ... in their member `value`.
template <class Row, std::size_t N>
consteval bool is_in_order(const std::array<Row, N>& table) {
  for (std::size_t n = 0; n < N; ++n) {
    if (static_cast<std::size_t>(table[n].value) != n) return false;
  }
  return true;
}

template <class Row, std::size_t N>
constexpr const Row& row_of(const std::array<Row, N>& table, decltype(Row::value) value) {
  return table[static_cast<std::size_t>(value)];
}

}  // namespace deliso
