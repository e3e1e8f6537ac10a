// SPDX-License-Identifier: MIT
// A reader of JSON (RFC 8259), and a validator for the keywords of JSON Schema 2020-12 that reports
// use: type, properties, required, additionalProperties, items, enum, const, minimum and oneOf. Any
// other keyword in a schema is a fault.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace json {

struct Value {
  enum class Kind { null, boolean, number, string, array, object };
  Kind kind = Kind::null;
  bool boolean = false;
  double number = 0;
  std::string string;
  std::vector<Value> items;
  std::map<std::string, Value> members;
  std::vector<std::string> order;  // of the members

  const Value* find(const std::string& key) const {
    const auto at = members.find(key);
    return at == members.end() ? nullptr : &at->second;
  }
  friend bool operator==(const Value&, const Value&) = default;
};

class Parser {
 public:
  explicit Parser(std::string_view text) : rest_(text) {}

  // Throws std::runtime_error if the text is no JSON or has a key twice.
  Value parse() {
    Value value = parse_value();
    skip_space();
    if (!rest_.empty()) fail("text after the end");
    return value;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(what + " before '" + std::string(rest_.substr(0, 20)) + "'");
  }
  void skip_space() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
  }
  bool take(std::string_view word) {
    if (!rest_.starts_with(word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }
  void expect(std::string_view word) {
    skip_space();
    if (!take(word)) fail("no " + std::string(word));
  }

  Value parse_value() {
    skip_space();
    Value value;
    if (take("null")) return value;
    if (rest_.starts_with("true") || rest_.starts_with("false")) {
      value.kind = Value::Kind::boolean;
      value.boolean = take("true");
      if (!value.boolean) take("false");
    } else if (rest_.starts_with('"')) {
      value.kind = Value::Kind::string;
      value.string = parse_string();
    } else if (take("[")) {
      value.kind = Value::Kind::array;
      for (skip_space(); !take("]"); skip_space()) {
        if (!value.items.empty()) expect(",");
        value.items.push_back(parse_value());
      }
    } else if (take("{")) {
      value.kind = Value::Kind::object;
      for (skip_space(); !take("}"); skip_space()) {
        if (!value.members.empty()) expect(",");
        skip_space();
        const std::string key = parse_string();
        expect(":");
        if (!value.members.emplace(key, parse_value()).second) fail("a second \"" + key + "\"");
        value.order.push_back(key);
      }
    } else {
      value.kind = Value::Kind::number;
      const char* end = rest_.data() + rest_.size();
      const auto [stop, error] = std::from_chars(rest_.data(), end, value.number);
      if (error != std::errc()) fail("no value");
      rest_.remove_prefix(static_cast<std::size_t>(stop - rest_.data()));
    }
    return value;
  }

  std::string parse_string() {
    if (!take("\"")) fail("no string");
    std::string text;
    while (!take("\"")) {
      if (rest_.empty()) fail("no end of a string");
      if (take("\\u")) {
        text += "?";
        rest_.remove_prefix(std::min<std::size_t>(4, rest_.size()));
        continue;
      }
      take("\\");
      if (rest_.empty()) fail("no end of a string");
      text += rest_.front();
      rest_.remove_prefix(1);
    }
    return text;
  }

  std::string_view rest_;
};

inline Value parse(std::string_view text) {
  return Parser(text).parse();
}

// Why `value` does not follow the schema: the first fault, with its place; empty: it does.
class Validator {
 public:
  explicit Validator(const Value& root) : root_(root) {}

  std::string fault(const Value& value) const { return fault(value, root_, "$"); }

 private:
  static bool has_type(const Value& value, const std::string& type) {
    constexpr std::array<std::string_view, 6> kNames{"null",   "boolean", "number",
                                                     "string", "array",   "object"};
    if (type == "integer") {
      return value.kind == Value::Kind::number && value.number == std::floor(value.number);
    }
    const auto at = std::ranges::find(kNames, type);
    if (at == kNames.end()) throw std::runtime_error("no type " + type);
    return value.kind == static_cast<Value::Kind>(at - kNames.begin());
  }

  std::string fault(const Value& value, const Value& schema, const std::string& at) const {
    for (const auto& [keyword, rule] : schema.members) {
      const std::string found = fault_by(value, schema, keyword, rule, at);
      if (!found.empty()) return found;
    }
    return {};
  }

  std::string fault_by(const Value& value, const Value& schema, const std::string& keyword,
                       const Value& rule, const std::string& at) const {
    constexpr std::array<std::string_view, 3> kNotes{"$schema", "title", "description"};
    if (std::ranges::find(kNotes, keyword) != kNotes.end()) return {};
    if (keyword == "oneOf") {
      std::string all;
      int fitting = 0;
      for (const Value& choice : rule.items) {
        const std::string found = fault(value, choice, at);
        fitting += found.empty();
        all += found + "; ";
      }
      return fitting == 1 ? "" : at + " follows " + std::to_string(fitting) + " of: " + all;
    }
    if (keyword == "type") {
      const std::vector<Value> types =
          rule.kind == Value::Kind::array ? rule.items : std::vector<Value>{rule};
      const bool fits =
          std::ranges::any_of(types, [&](const Value& t) { return has_type(value, t.string); });
      return fits ? "" : at + " has the wrong type";
    }
    if (keyword == "const") return value == rule ? "" : at + " has the wrong value";
    if (keyword == "enum") {
      return std::ranges::find(rule.items, value) != rule.items.end() ? "" : at + " is no choice";
    }
    if (keyword == "minimum") {
      const bool fits = value.kind != Value::Kind::number || value.number >= rule.number;
      return fits ? "" : at + " is too small";
    }
    if (keyword == "required") {
      for (const Value& key : rule.items) {
        if (value.find(key.string) == nullptr) return at + " has no \"" + key.string + "\"";
      }
      return {};
    }
    if (keyword == "items") {
      for (std::size_t n = 0; n < value.items.size(); ++n) {
        const std::string found = fault(value.items[n], rule, at + "[" + std::to_string(n) + "]");
        if (!found.empty()) return found;
      }
      return {};
    }
    if (keyword == "properties") {
      for (const auto& [key, member] : value.members) {
        const Value* rule_of = rule.find(key);
        if (rule_of == nullptr) continue;
        const std::string found = fault(member, *rule_of, at + "." + key);
        if (!found.empty()) return found;
      }
      return {};
    }
    if (keyword == "additionalProperties") {
      const Value* named = schema.find("properties");
      for (const auto& [key, member] : value.members) {
        if (named != nullptr && named->find(key) != nullptr) continue;
        if (rule.kind == Value::Kind::boolean) {
          if (!rule.boolean) return at + " has an unknown \"" + key + "\"";
          continue;
        }
        const std::string found = fault(member, rule, at + "." + key);
        if (!found.empty()) return found;
      }
      return {};
    }
    throw std::runtime_error("the schema has an unknown keyword " + keyword);
  }

  const Value& root_;
};

}  // namespace json
