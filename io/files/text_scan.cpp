// SPDX-License-Identifier: MIT
#include "io/files/text_scan.h"

#include <algorithm>

namespace deliso {
namespace {

template <class T>
std::optional<std::vector<T>> to_numbers(std::string_view text) {
  std::vector<T> numbers;
  for (std::string_view word : words_of(text)) {
    const std::optional<T> number = number_in<T>(word);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace

std::string_view TextCursor::line() {
  const std::size_t end = std::min(text_.find('\n', position_), text_.size());
  std::string_view line = text_.substr(position_, end - position_);
  position_ = std::min(end + 1, text_.size());
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

std::string_view TextCursor::word() {
  while (!at_end() && is_space(text_[position_])) ++position_;
  const std::size_t begin = position_;
  while (!at_end() && !is_space(text_[position_])) ++position_;
  return text_.substr(begin, position_ - begin);
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

std::string with_long_numbers(std::string_view name) {
  constexpr std::string_view kDecimals = "0123456789";
  std::string out;
  while (!name.empty()) {
    const std::size_t digits = std::min(name.find_first_not_of(kDecimals), name.size());
    if (digits > 0 && digits < 20) out.append(20 - digits, '0');
    const std::size_t end = std::min(name.find_first_of(kDecimals, digits), name.size());
    out += name.substr(0, end);
    name.remove_prefix(end);
  }
  return out;
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  TextCursor cursor(text);
  for (std::string_view word = cursor.word(); !word.empty(); word = cursor.word())
    words.push_back(word);
  return words;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at <= text.size(); at += parts.back().size() + 1) {
    parts.push_back(text.substr(at, text.find(separator, at) - at));
  }
  return parts;
}

std::optional<std::vector<std::int64_t>> to_ints(std::string_view text) {
  return to_numbers<std::int64_t>(text);
}

std::optional<std::vector<double>> to_doubles(std::string_view text) {
  return to_numbers<double>(text);
}

std::string quote(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string quoted = "'";
  quoted.append(text.substr(0, longest)).append(text.size() > longest ? "...'" : "'");
  return quoted;
}

}  // namespace deliso
