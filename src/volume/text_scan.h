// SPDX-License-Identifier: MIT
// The little text handling that volume headers need: lines, words, numbers. Nothing here throws or
// allocates more than its result; a fault is a missing value, and the reader names it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace deliso {

// Walks over text line by line or word by word. The views it returns point into the text.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text) : text_(text) {}

  bool at_end() const { return position_ == text_.size(); }
  // Offset of the next unread character.
  std::size_t position() const { return position_; }
  std::string_view rest() const { return text_.substr(position_); }

  // The next line without its end ("\n" or "\r\n"); empty at the end of the text.
  std::string_view line();
  // The next run of characters other than white space; empty at the end of the text.
  std::string_view word();

 private:
  std::string_view text_;
  std::size_t position_ = 0;
};

bool is_space(char c);
std::string_view trimmed(std::string_view text);
std::string lower(std::string_view text);
bool starts_with_ignoring_case(std::string_view text, std::string_view prefix);
std::vector<std::string_view> words_of(std::string_view text);

// The whole of `text` as a number ("+5" too); nothing if it is no number or does not fit.
std::optional<std::int64_t> to_int(std::string_view text);
std::optional<double> to_double(std::string_view text);
// The whole of `text` as white-space separated numbers; nothing if a word is no number.
std::optional<std::vector<std::int64_t>> to_ints(std::string_view text);
std::optional<std::vector<double>> to_doubles(std::string_view text);

// 'text' as it may stand in a one-line message: shortened, control characters replaced.
std::string quote(std::string_view text);

}  // namespace deliso
