// SPDX-License-Identifier: MIT
// A small writer of JSON (RFC 8259): nested objects, flat arrays, two-space indentation. Keys come
// out in the order they are added, numbers in the shortest form that reads back the same, so equal
// content gives equal bytes.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace deliso {

class JsonWriter {
 public:
  JsonWriter();

  void open(std::string_view key);  // begins an object within the current one
  void close();                     // ends it

  void add(std::string_view key, std::string_view value);
  void add(std::string_view key, const char* value) { add(key, std::string_view(value)); }
  void add(std::string_view key, double value);  // null where it is not finite
  void add(std::string_view key, std::initializer_list<double> values);
  void add(std::string_view key, bool value);
  void add(std::string_view key, std::integral auto value) {
    begin_member(key);
    text_ += std::to_string(value);
  }

  // Ends the outermost object and gives the whole text, with a newline at its end.
  // pre: every open() has had its close().
  std::string finish();

 private:
  void begin_member(std::string_view key);
  void append_number(double value);
  void append_string(std::string_view s);

  std::string text_;
  int depth_ = 1;
  bool first_ = true;
};

}  // namespace deliso
