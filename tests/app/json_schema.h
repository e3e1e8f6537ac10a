// SPDX-License-Identifier: MIT
// A validator for the keywords of JSON Schema 2020-12 that reports use: type, properties, required,
// additionalProperties, items, enum, const, minimum and oneOf. Any other keyword in a schema is a
// fault, and so is a key that an object has twice.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "io/files/json_value.h"

namespace deliso::test {

// Why `value` does not follow the schema: the first fault, with its place; empty: it does.
class Validator {
 public:
  explicit Validator(const JsonValue& root) : root_(root) {}

  std::string fault(const JsonValue& value) const { return fault(value, root_, "$"); }

 private:
  static bool has_type(const JsonValue& value, const std::string& type) {
    constexpr std::array<std::string_view, 6> kNames{"null",   "boolean", "number",
                                                     "string", "array",   "object"};
    if (type == "integer") {
      return value.kind == JsonValue::Kind::number && value.number == std::floor(value.number);
    }
    const auto at = std::ranges::find(kNames, type);
    if (at == kNames.end()) throw std::runtime_error("no type " + type);
    return value.kind == static_cast<JsonValue::Kind>(at - kNames.begin());
  }

  std::string fault(const JsonValue& value, const JsonValue& schema, const std::string& at) const {
    for (const std::string& key : value.keys) {
      if (std::ranges::count(value.keys, key) > 1) return text(at, " has two \"", key, '"');
    }
    for (const std::string& keyword : schema.keys) {
      const std::string found = fault_by(value, schema, keyword, schema[keyword], at);
      if (!found.empty()) return found;
    }
    return {};
  }

  std::string fault_by(const JsonValue& value, const JsonValue& schema, const std::string& keyword,
                       const JsonValue& rule, const std::string& at) const {
    constexpr std::array<std::string_view, 3> kNotes{"$schema", "title", "description"};
    if (std::ranges::find(kNotes, keyword) != kNotes.end()) return {};
    if (keyword == "oneOf") {
      std::string all;
      int fitting = 0;
      for (const JsonValue& choice : rule.items) {
        const std::string found = fault(value, choice, at);
        fitting += found.empty();
        all += found + "; ";
      }
      return fitting == 1 ? "" : at + " follows " + std::to_string(fitting) + " of: " + all;
    }
    if (keyword == "type") {
      const std::vector<JsonValue> types =
          rule.kind == JsonValue::Kind::array ? rule.items : std::vector<JsonValue>{rule};
      const bool fits =
          std::ranges::any_of(types, [&](const JsonValue& t) { return has_type(value, t.string); });
      return fits ? "" : at + " has the wrong type";
    }
    const auto is_value = [&](const JsonValue& choice) {
      return value.kind == choice.kind && value.number == choice.number &&
             value.string == choice.string;
    };
    if (keyword == "const") return is_value(rule) ? "" : at + " has the wrong value";
    if (keyword == "enum") {
      return std::ranges::any_of(rule.items, is_value) ? "" : at + " is no choice";
    }
    if (keyword == "minimum") {
      const bool fits = value.kind != JsonValue::Kind::number || value.number >= rule.number;
      return fits ? "" : at + " is too small";
    }
    if (keyword == "required") {
      for (const JsonValue& key : rule.items) {
        if (std::ranges::count(value.keys, key.string) == 0)
          return at + " has no \"" + key.string + "\"";
      }
      return {};
    }
    if (keyword == "items") {
      const bool is_list = value.kind == JsonValue::Kind::array;
      for (std::size_t n = 0; is_list && n < value.items.size(); ++n) {
        const std::string found = fault(value.items[n], rule, at + "[" + std::to_string(n) + "]");
        if (!found.empty()) return found;
      }
      return {};
    }
    if (keyword == "properties") {
      for (const std::string& key : value.keys) {
        if (rule[key].is_null()) continue;
        const std::string found = fault(value[key], rule[key], at + "." + key);
        if (!found.empty()) return found;
      }
      return {};
    }
    if (keyword == "additionalProperties") {
      for (const std::string& key : value.keys) {
        if (!schema["properties"][key].is_null()) continue;
        if (rule.kind == JsonValue::Kind::boolean) {
          if (rule.number == 0) return at + " has an unknown \"" + key + "\"";
          continue;
        }
        const std::string found = fault(value[key], rule, at + "." + key);
        if (!found.empty()) return found;
      }
      return {};
    }
    throw std::runtime_error("the schema has an unknown keyword " + keyword);
  }

  const JsonValue& root_;
};

}  // namespace deliso::test
