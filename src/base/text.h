// SPDX-License-Identifier: MIT
// Text from pieces. A number is written with the fewest digits that read back as the same number.
// The result is the same in every locale and on every machine (std::to_chars).
#pragma once

#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>
#include <variant>

#include "base/ids.h"

namespace deliso {

// A piece of a text: a number, or characters that it refers to.
using TextPiece =
    std::variant<std::string_view, char, long long, unsigned long long, float, double>;

template <class T>
TextPiece text_piece(const T& part) {
  if constexpr (std::convertible_to<const T&, std::string_view>) {
    return std::string_view(part);
  } else if constexpr (std::same_as<T, char> || std::floating_point<T>) {
    return part;
  } else if constexpr (std::signed_integral<T>) {
    return static_cast<long long>(part);
  } else {
    static_assert(std::unsigned_integral<T> && !std::same_as<T, bool>);
    return static_cast<unsigned long long>(part);
  }
}
template <class Tag>
TextPiece text_piece(Id<Tag> id) {
  return text_piece(id.number());
}

// One function for all texts: made anew for each list of types, texts were a quarter of the
// readers' code.
std::string joined(std::initializer_list<TextPiece> pieces);

// text("facet ", 7, " of ", 9.5) == "facet 7 of 9.5".
template <class... Parts>
std::string text(const Parts&... parts) {
  return joined({text_piece(parts)...});
}

// Returns piece(item) for all items, with `between` between one and the next.
template <class Items, class Piece>
std::string joined(const Items& items, std::string_view between, Piece piece) {
  std::string all;
  for (const auto& item : items) {
    if (!all.empty()) all += between;
    all += text(piece(item));
  }
  return all;
}
template <class Items>
std::string joined(const Items& items, std::string_view between) {
  return joined(items, between, [](const auto& item) { return item; });
}

}  // namespace deliso
