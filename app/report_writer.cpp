// SPDX-License-Identifier: MIT
#include "app/report_writer.h"

#include <iterator>
#include <utility>

#include "base/version.h"

namespace deliso {
namespace {

// The version of the schema, whose description says when it rises.
constexpr int kSchema = 1;

}  // namespace

ReportWriter::ReportWriter(std::string_view command) {
  json_.add("schema", kSchema);
  json_.add("command", command);
  json_.add("version", kVersion);
}

ReportWriter::ReportWriter() : required_(1) {
  json_.add("$schema", "https://json-schema.org/draft/2020-12/schema");
  json_.add("title", "What deliso mesh, check and info write with --json");
  json_.add("description",
            "Lengths are in the unit that is named. The scaled frame is the volume's own: its "
            "spacing, no origin, no rotation. r is a triangle's circumradius, l its shortest edge, "
            "h the distance of its circumcenter from the surface. Counters, operations, refusals "
            "and faults are explained in docs/glossary.md. The version (schema) rises by one "
            "when a key goes, is renamed, or changes its type, unit or meaning; keys that are only "
            "added come with a new version of the program, whose schema names them.");
  json_.open_list("oneOf");
}

void ReportWriter::add_values(std::string_view key,
                              std::span<const std::pair<std::string_view, double>> values,
                              std::string_view words) {
  const bool described = !required_.empty();
  described ? open_member(key) : json_.open(key);
  if (described) {
    json_.add("type", "object");
    json_.add("description", words);
    json_.open("additionalProperties");
    json_.add("type", "number");
    json_.close();
  }
  for (const auto& [name, value] : values) json_.add(name, value);
  json_.close();
}

void ReportWriter::open(std::string_view key, std::string_view words) {
  if (required_.empty()) return json_.open(key);
  open_member(key);
  open_properties(words);
}

void ReportWriter::close(bool has_others) {
  json_.close();
  if (required_.empty()) return;
  json_.add("required", required_.back());
  json_.add("additionalProperties", has_others);
  json_.close();
  required_.pop_back();
}

void ReportWriter::describe_report(std::string_view command, const std::function<void()>& fill,
                                   std::string_view options) {
  json_.open_item();
  open_properties(text("of deliso ", command, " --json", options.empty() ? "" : " ", options));
  open_member("schema");
  json_.add("const", kSchema);
  json_.close();
  open_member("command");
  json_.add("const", command);
  json_.close();
  add("version", "", "of the program");
  fill();
  close();
}

std::string ReportWriter::finish() {
  if (!required_.empty()) json_.close();
  return json_.finish();
}

bool ReportWriter::describes(std::string_view key, std::string_view type, std::string_view words,
                             Rule rule, bool is_list, std::span<const std::string> choices) {
  if (required_.empty()) return std::exchange(is_left_out_, false);
  open_member(key);
  if (is_list) {
    json_.add("type", "array");
    json_.open("items");
  }
  describe_type(type, rule);
  if (is_list) json_.close();
  if (!choices.empty()) json_.add("enum", choices);
  json_.add("description", words);
  json_.close();
  return true;
}

bool ReportWriter::describes_objects(std::string_view key, std::string_view words) {
  if (required_.empty()) return false;
  open_member(key);
  json_.add("type", "array");
  json_.open("items");
  open_properties(words);
  return true;
}

void ReportWriter::describe_type(std::string_view type, Rule rule) {
  if (rule == Rule::nullable) {
    json_.add("type", std::vector<std::string>{std::string(type), "null"});
  } else {
    json_.add("type", type);
  }
  if (rule == Rule::not_negative || rule == Rule::positive) {
    json_.add("minimum", rule == Rule::positive ? 1 : 0);
  }
}

void ReportWriter::open_member(std::string_view key) {
  if (!is_optional_) required_.back().emplace_back(key);
  is_optional_ = false;
  json_.open(key);
}

void ReportWriter::open_properties(std::string_view words) {
  json_.add("type", "object");
  json_.add("description", words);
  json_.open("properties");
  required_.emplace_back();
}

void add_diagnostics(ReportWriter& out, const Diagnostics& notes) {
  const std::vector<std::string> codes(std::begin(kCodes), std::end(kCodes));
  out.add_objects("diagnostics", "notes and warnings, in the order in which they came", notes,
                  [&](const Diagnostic& item) {
                    out.add_choice("code", item.code.number(), codes, "docs/glossary.md");
                    out.add_choice("severity", static_cast<std::size_t>(item.severity),
                                   names_up_to(Severity::warning),
                                   "a warning: the result may not be the one wanted");
                    out.add("words", item.words, "one line, without the file");
                    out.add("file", item.file, "that it is about; empty: none");
                    out.add_values("values", item.values,
                                   "numbers of the words, by name; {}: none");
                  });
}

}  // namespace deliso
