// SPDX-License-Identifier: MIT
// Text from pieces. A number is written with the fewest digits that read back as the same number.
// The result is the same in every locale and on every machine (std::to_chars).
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
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

// Returns the length of the UTF-8 sequence at the beginning of s; 0 if there is none. Overlong
// forms and surrogates pass, so a path with them reads back as the same bytes. pre: not empty.
inline std::size_t utf8_length(std::string_view s) {
  const auto lead = static_cast<unsigned char>(s[0]);
  const std::size_t length = lead < 0x80              ? 1
                             : (lead & 0xe0u) == 0xc0 ? 2
                             : (lead & 0xf0u) == 0xe0 ? 3
                             : (lead & 0xf8u) == 0xf0 ? 4
                                                      : 0;
  if (length > s.size()) return 0;
  for (std::size_t n = 1; n < length; ++n) {
    if ((static_cast<unsigned char>(s[n]) & 0xc0u) != 0x80) return 0;
  }
  return length;
}

// True if the UTF-8 sequence is a control character, one of two bytes or overlong included.
inline bool is_control(std::string_view sequence) {
  const std::size_t length = sequence.size();
  std::uint32_t code =
      static_cast<unsigned char>(sequence[0]) & (length == 1 ? 0x7fu : 0x7fu >> length);
  for (const char c : sequence.substr(1))
    code = code << 6 | (static_cast<unsigned char>(c) & 0x3fu);
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || (length > 1 && code < 0x80);
}

}  // namespace deliso
