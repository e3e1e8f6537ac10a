// SPDX-License-Identifier: MIT
// A small writer of JSON (RFC 8259): nested objects and lists, two-space indentation. Keys keep
// their order, and numbers have the shortest form that reads back the same. So equal content gives
// equal bytes.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace deliso {

class JsonWriter {
 public:
  JsonWriter();

  void open(std::string_view key);       // begins an object within the current one
  void open_list(std::string_view key);  // begins a list of objects there
  void open_item();                      // begins an object in the current list
  void close();                          // ends the innermost object or list

  void add(std::string_view key, std::string_view value);
  void add(std::string_view key, const char* value) { add(key, std::string_view(value)); }
  void add(std::string_view key, double value);  // null if it is not finite
  void add(std::string_view key, std::initializer_list<double> values) {
    add(key, std::span(values.begin(), values.size()));
  }
  void add(std::string_view key, std::span<const double> values);
  void add(std::string_view key, std::span<const std::int64_t> values);
  void add(std::string_view key, std::span<const std::string> values);
  void add(std::string_view key, bool value);
  void add(std::string_view key, std::integral auto value) {
    begin_member(key);
    text_ += std::to_string(value);
  }

  // Ends the outermost object and returns the whole text, with a newline at its end. pre: every
  // other object and list is closed.
  std::string finish();

 private:
  void open_bracket(char bracket);
  void begin_line();
  void begin_member(std::string_view key);
  template <class T>
  void add_list(std::string_view key, std::span<const T> values);
  void append(double value);
  void append(std::int64_t value);
  void append(std::string_view s);

  std::string text_;
  std::string open_;  // brackets not closed yet
  bool first_ = true;
};

}  // namespace deliso
