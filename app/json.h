// SPDX-License-Identifier: MIT
// A small writer of JSON (RFC 8259): nested objects and lists, two-space indentation. Keys come
// out in the order they are added, numbers in the shortest form that reads back the same, so equal
// content gives equal bytes.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace deliso {

// The version of what the commands write; docs/report.schema.json says when it rises.
inline constexpr int kSchema = 1;

class JsonWriter {
 public:
  JsonWriter();
  // What a command writes: begins with "schema", "command" and "version".
  explicit JsonWriter(std::string_view command);

  void open(std::string_view key);       // begins an object within the current one
  void open_list(std::string_view key);  // begins a list of objects there
  void open_item();                      // begins an object in the current list
  void close();                          // ends the innermost object or list

  void add(std::string_view key, std::string_view value);
  void add(std::string_view key, const char* value) { add(key, std::string_view(value)); }
  void add(std::string_view key, double value);  // null where it is not finite
  void add(std::string_view key, std::initializer_list<double> values);
  void add(std::string_view key, std::span<const std::string> values);
  void add(std::string_view key, bool value);
  void add(std::string_view key, std::integral auto value) {
    begin_member(key);
    text_ += std::to_string(value);
  }

  // Ends the outermost object and gives the whole text, with a newline at its end.
  // pre: everything opened has been closed.
  std::string finish();

 private:
  void open_bracket(char bracket);
  void begin_line();
  void begin_member(std::string_view key);
  void append_number(double value);
  void append_string(std::string_view s);

  std::string text_;
  std::string open_;  // the brackets that are not closed
  bool first_ = true;
};

}  // namespace deliso
