// SPDX-License-Identifier: MIT
// Lines, words and numbers of text files. Nothing here throws or allocates more than its result. A
// fault is a missing value; the reader reports it.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace deliso {

// Walks over text line by line or word by word. The views it returns point into the text.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text) : text_(text) {}

  bool at_end() const { return position_ == text_.size(); }
  // Returns the offset of the next unread character.
  std::size_t position() const { return position_; }
  std::string_view rest() const { return text_.substr(position_); }

  // Skips `count` characters. pre: the text has them.
  void skip(std::size_t count) { position_ += count; }
  // Returns the next line without its end ("\n" or "\r\n"); empty at the end of the text.
  std::string_view line();
  // Returns the next word, up to white space; empty at the end of the text.
  std::string_view word();

 private:
  std::string_view text_;
  std::size_t position_ = 0;
};

constexpr bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}
std::string_view trimmed(std::string_view text);
std::string lower(std::string_view text);
// Returns `name` with its numbers filled up with zeros: in the order of these, slice2 comes before
// slice10.
std::string with_long_numbers(std::string_view name);
std::vector<std::string_view> words_of(std::string_view text);
// Returns what stands between the separators: one part more than there are.
std::vector<std::string_view> split(std::string_view text, char separator);

// Returns all of `text` as a number ("+5" too); nullopt if it is no number or does not fit.
template <class T>
std::optional<T> number_in(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  T value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}
inline std::optional<std::int64_t> to_int(std::string_view text) {
  return number_in<std::int64_t>(text);
}
inline std::optional<double> to_double(std::string_view text) {
  return number_in<double>(text);
}
// Returns all of `text` as numbers between white space; nullopt if a word is no number.
std::optional<std::vector<std::int64_t>> to_ints(std::string_view text);
std::optional<std::vector<double>> to_doubles(std::string_view text);

// Returns 'text' shortened for a message. (InputError replaces control characters.)
std::string quote(std::string_view text);

}  // namespace deliso
