// SPDX-License-Identifier: MIT
#include "base/text.h"

#include <charconv>

namespace deliso {
namespace {

void append(std::string& text, std::string_view part) {
  text += part;
}
void append(std::string& text, char letter) {
  text += letter;
}
void append(std::string& text, auto number) {
  char digits[32];  // the longest double, -2.2250738585072014e-308, takes 24
  text.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

}  // namespace

std::string joined(std::initializer_list<TextPiece> pieces) {
  std::string all;
  for (const TextPiece& piece : pieces) {
    std::visit([&](auto part) { append(all, part); }, piece);
  }
  return all;
}

}  // namespace deliso
