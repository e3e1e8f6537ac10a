// SPDX-License-Identifier: MIT
// The fields of a header of lines "name: value" (NRRD) or "name = value" (MetaImage), by their
// names in any case.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/input_file.h"
#include "io/files/text_scan.h"

namespace deliso {

class HeaderFields {
 public:
  // Messages have the name of the file, and call a field `noun`.
  HeaderFields(const std::string& file, std::string_view noun) : file_(file), noun_(noun) {}

  void set(std::string_view field, std::string_view value) {
    fields_[lower(trimmed(field))] = trimmed(value);
  }

  // Returns the value of the first of these spellings that the header has.
  std::optional<std::string_view> find(std::initializer_list<std::string_view> spellings) const {
    for (const std::string_view field : spellings) {
      if (const auto found = fields_.find(lower(field)); found != fields_.end())
        return found->second;
    }
    return std::nullopt;
  }
  bool has(std::string_view field) const { return find({field}).has_value(); }
  std::string_view get(std::string_view field, std::string_view fallback) const {
    return find({field}).value_or(fallback);
  }
  std::string_view get(std::string_view field) const {
    if (!has(field)) fail(file_, "the header has no ", noun_, " '", field, "'");
    return get(field, "");
  }
  std::int64_t integer(std::string_view field) const {
    const std::optional<std::int64_t> value = to_int(get(field));
    if (!value) fail_field(field, "not an integer");
    return *value;
  }
  std::int64_t integer(std::string_view field, std::int64_t fallback) const {
    return has(field) ? integer(field) : fallback;
  }
  // Returns `count` numbers; nullopt if the header has no such field.
  std::optional<std::vector<double>> numbers(std::initializer_list<std::string_view> spellings,
                                             std::size_t count) const {
    const std::optional<std::string_view> value = find(spellings);
    if (!value) return std::nullopt;
    std::optional<std::vector<double>> numbers = to_doubles(*value);
    if (!numbers || numbers->size() != count)
      fail_value(*spellings.begin(), *value, "not ", count, " numbers");
    return numbers;
  }
  [[noreturn]] void fail_field(std::string_view field, const auto&... fault) const {
    fail_value(field, get(field, ""), fault...);
  }

 private:
  [[noreturn]] void fail_value(std::string_view field, std::string_view value,
                               const auto&... fault) const {
    fail(file_, noun_, " '", field, "' is ", quote(value), ": ", fault...);
  }

  const std::string& file_;
  std::string_view noun_;
  std::map<std::string, std::string_view> fields_;
};

}  // namespace deliso
