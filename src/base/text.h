// SPDX-License-Identifier: MIT
// Text from pieces. A number is written with the fewest digits that read back as the same number.
// The result is the same in every locale and on every machine (std::to_chars).
#pragma once

#include <charconv>
#include <concepts>
#include <string>
#include <string_view>

#include "base/ids.h"

namespace deliso {

inline void append_text(std::string& text, std::string_view part) {
  text.append(part);
}
inline void append_text(std::string& text, char letter) {
  text += letter;
}

template <class T>
requires std::integral<T> || std::floating_point<T>
void append_text(std::string& text, T number) {
  char digits[32];  // the longest double, -2.2250738585072014e-308, takes 24
  text.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

template <class Tag>
void append_text(std::string& text, Id<Tag> id) {
  append_text(text, id.number());
}

// text("facet ", 7, " of ", 9.5) == "facet 7 of 9.5".
template <class... Parts>
std::string text(const Parts&... parts) {
  std::string all;
  (append_text(all, parts), ...);
  return all;
}

// Returns piece(item) for all items, with `between` between one and the next.
template <class Items, class Piece>
std::string joined(const Items& items, std::string_view between, Piece piece) {
  std::string all;
  for (const auto& item : items) {
    append_text(all, all.empty() ? std::string_view() : between);
    append_text(all, piece(item));
  }
  return all;
}
template <class Items>
std::string joined(const Items& items, std::string_view between) {
  return joined(items, between, [](const auto& item) { return item; });
}

}  // namespace deliso
