// SPDX-License-Identifier: MIT
#include "io/files/json.h"

#include <cmath>
#include <utility>

#include "base/check.h"
#include "base/text.h"

namespace deliso {
JsonWriter::JsonWriter() {
  open_bracket('{');
}

void JsonWriter::open(std::string_view key) {
  begin_member(key);
  open_bracket('{');
}

void JsonWriter::open_list(std::string_view key) {
  begin_member(key);
  open_bracket('[');
}

void JsonWriter::open_item() {
  DELISO_CHECK(open_.ends_with('['));
  begin_line();
  open_bracket('{');
}

void JsonWriter::close() {
  DELISO_CHECK(!open_.empty());
  const char closing = open_.back() == '{' ? '}' : ']';
  open_.pop_back();
  if (!first_) {
    text_ += '\n';
    text_.append(2 * open_.size(), ' ');
  }
  text_ += closing;
  first_ = false;
}

void JsonWriter::add(std::string_view key, std::string_view value) {
  begin_member(key);
  append(value);
}

void JsonWriter::add(std::string_view key, double value) {
  begin_member(key);
  append(value);
}

void JsonWriter::add(std::string_view key, std::span<const double> values) {
  add_list(key, values);
}

void JsonWriter::add(std::string_view key, std::span<const std::int64_t> values) {
  add_list(key, values);
}

void JsonWriter::add(std::string_view key, std::span<const std::string> values) {
  add_list(key, values);
}

void JsonWriter::add(std::string_view key, bool value) {
  begin_member(key);
  text_ += value ? "true" : "false";
}

std::string JsonWriter::finish() {
  DELISO_CHECK(open_.size() == 1);
  close();
  return std::move(text_) + '\n';
}

void JsonWriter::open_bracket(char bracket) {
  text_ += bracket;
  open_ += bracket;
  first_ = true;
}

void JsonWriter::begin_line() {
  text_ += first_ ? "\n" : ",\n";
  text_.append(2 * open_.size(), ' ');
  first_ = false;
}

void JsonWriter::begin_member(std::string_view key) {
  DELISO_CHECK(open_.ends_with('{'));
  begin_line();
  append(key);
  text_ += ": ";
}

template <class T>
void JsonWriter::add_list(std::string_view key, std::span<const T> values) {
  begin_member(key);
  text_ += '[';
  const char* before = "";
  for (const T& value : values) {
    text_ += std::exchange(before, ", ");
    append(value);
  }
  text_ += ']';
}

void JsonWriter::append(double value) {
  text_ += std::isfinite(value) ? text(value) : "null";
}

void JsonWriter::append(std::int64_t value) {
  text_ += std::to_string(value);
}

void JsonWriter::append(std::string_view s) {
  constexpr std::string_view kHex = "0123456789abcdef";
  text_ += '"';
  while (!s.empty()) {
    const std::size_t length = utf8_length(s);
    const auto c = static_cast<unsigned char>(s[0]);
    if (length == 0) {
      text_ += "\\ufffd";
    } else if (c == '"' || c == '\\') {
      text_ += '\\';
      text_ += s[0];
    } else if (c < 0x20) {
      text_ += "\\u00";
      text_ += kHex[c >> 4];
      text_ += kHex[c & 15u];
    } else {
      text_ += s.substr(0, length);
    }
    s.remove_prefix(length == 0 ? 1 : length);
  }
  text_ += '"';
}

}  // namespace deliso
