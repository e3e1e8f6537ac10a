// SPDX-License-Identifier: MIT
// Writes a report as JSON, or describes it as a JSON Schema. One function for each object gives the
// key, the value and the meaning of every member. It serves both, so they cannot differ. A schema
// is made from values of no run, with every optional member taken.
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/text.h"
#include "base/vec3.h"
#include "io/files/json.h"
#include "volume/volume.h"

namespace deliso {

// What a schema says of a number beside its type.
enum class Rule : std::uint8_t { none, not_negative, positive, nullable };

// A number of a list in both reports: by its key in the JSON, by its label in the text. No label:
// it is in the JSON alone.
struct Figure {
  std::string_view key, label;
  double value;
  std::string_view words;  // its meaning
};

// Returns the names of all values of an enumeration, for add_choice().
template <class T>
std::vector<std::string> names_up_to(T last) {
  std::vector<std::string> names;
  for (std::size_t n = 0; n <= static_cast<std::size_t>(last); ++n) {
    names.emplace_back(name_of(static_cast<T>(n)));
  }
  return names;
}

class ReportWriter {
 public:
  explicit ReportWriter(std::string_view command);  // writes
  ReportWriter();                                   // describes

  // Each adds a member. `words` are its meaning, with the unit at the end: "the largest h; voxels".
  void add(std::string_view key, std::string_view value, std::string_view words) {
    if (!describes(key, "string", words)) json_.add(key, value);
  }
  void add(std::string_view key, const char* value, std::string_view words) {
    add(key, std::string_view(value), words);
  }
  void add(std::string_view key, bool value, std::string_view words) {
    if (!describes(key, "boolean", words)) json_.add(key, value);
  }
  void add(std::string_view key, double value, std::string_view words, Rule rule = Rule::none) {
    if (!describes(key, "number", words, rule)) json_.add(key, value);
  }
  template <std::integral T>
  void add(std::string_view key, T value, std::string_view words,
           Rule rule = std::unsigned_integral<T> ? Rule::not_negative : Rule::none) {
    if (!describes(key, "integer", words, rule)) json_.add(key, value);
  }
  void add_seconds(std::string_view key, double seconds, std::string_view words) {
    add(key, seconds, text(words, "; seconds of wall clock"), Rule::not_negative);
  }
  void add(std::string_view key, const Vec3& v, std::string_view words) {
    add_list(key, std::vector{v.x, v.y, v.z}, "number", words);
  }
  void add(std::string_view key, Index3 n, std::string_view words, Rule rule) {
    add_list(key, std::vector{double(n.i), double(n.j), double(n.k)}, "integer", words, rule);
  }
  void add_list(std::string_view key, std::span<const double> values, std::string_view type,
                std::string_view words, Rule rule = Rule::none) {
    if (!describes(key, type, words, rule, true)) json_.add(key, values);
  }
  void add_list(std::string_view key, std::span<const std::int64_t> values,
                std::string_view words) {
    if (!describes(key, "integer", words, Rule::none, true)) json_.add(key, values);
  }
  void add_choice(std::string_view key, std::size_t choice, std::span<const std::string> choices,
                  std::string_view words) {
    if (!describes(key, "string", words, Rule::none, false, choices))
      json_.add(key, choices[choice]);
  }
  // Adds an object of numbers with these names.
  void add_values(std::string_view key, std::span<const std::pair<std::string_view, double>> values,
                  std::string_view words);
  void open(std::string_view key, std::string_view words);
  void close(bool has_others = false);  // whether other members are allowed

  // True if the next member is to be added: it is present, or described as one that may be absent.
  bool if_any(bool is_present) {
    is_optional_ = true;
    return is_present || !required_.empty();
  }
  // Leaves out the next member, which is no object, unless it is to be added.
  ReportWriter& optional(bool is_present) {
    is_left_out_ = !if_any(is_present);
    return *this;
  }

  // Adds a list of objects; `fill` adds the members of one.
  template <class T, class Fill>
  void add_objects(std::string_view key, std::string_view words, const std::vector<T>& items,
                   const Fill& fill) {
    const bool described = describes_objects(key, words);
    if (!described) json_.open_list(key);
    for (const T& item : described ? std::vector<T>(1) : items) {
      if (!described) json_.open_item();
      fill(item);
      close();
    }
    json_.close();
  }

  // Describes the report of a command, whose members `fill` adds. `options`: those that it is of.
  void describe_report(std::string_view command, const std::function<void()>& fill,
                       std::string_view options = {});
  std::string finish();  // the report, or the schema

 private:
  // If the writer describes: describes a member of this type, and returns true. Also true of one
  // that is left out.
  bool describes(std::string_view key, std::string_view type, std::string_view words,
                 Rule rule = Rule::none, bool is_list = false,
                 std::span<const std::string> choices = {});
  bool describes_objects(std::string_view key, std::string_view words);
  void describe_type(std::string_view type, Rule rule);
  void open_member(std::string_view key);
  void open_properties(std::string_view words);

  JsonWriter json_;
  std::vector<std::vector<std::string>> required_;  // of open objects; empty: the writer writes
  bool is_optional_ = false, is_left_out_ = false;  // the next member
};

// Adds "peak_memory_bytes".
void add_memory(ReportWriter& out, std::uint64_t bytes);
// Adds the list "diagnostics".
void add_diagnostics(ReportWriter& out, const Diagnostics& notes);

}  // namespace deliso
