// SPDX-License-Identifier: MIT
// What a run tells beside its results: one list of notes and warnings. Readers, the mesher and
// writers add to it. It comes out in the report (notes), on standard error (warnings), in the JSON
// of every command, in C and in Python.
//
// 1. A code names a kind of diagnostic for programs. It stays; the words may change.
// 2. A warning says that a result may not be what the user wants. All else is a note.
// 3. No two items of a list have the same severity, code, words and file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text.h"

namespace deliso {

enum class Severity : std::uint8_t { note, warning };

constexpr std::string_view name_of(Severity severity) {
  return severity == Severity::note ? "note" : "warning";
}

// All codes. docs/glossary.md explains them.
inline constexpr std::string_view kCodes[] = {
    "array-chosen",
    "axis-without-direction",
    "bytes-after-samples",
    "channels-as-slices",
    "coarse-surface",
    "coordinates-given",
    "copies-left-out",
    "count-missed",
    "faces-inwards",
    "field-differs",
    "files-passed-over",
    "files-unreadable",
    "first-of-several",
    "gray-image",
    "inverted-gray",
    "isovalue-of-mask",
    "isovalue-on-samples",
    "label-vanished",
    "many-vertices",
    "may-be-color",
    "nan-replaced",
    "open-at-border",
    "option-ignored",
    "orientation-unknown",
    "origin-given",
    "page-distance-unknown",
    "rescaled",
    "rounded-to-float",
    "segments-named",
    "series-left-out",
    "several-series",
    "sheared-grid",
    "slice-count",
    "slice-distance-guessed",
    "slices-by-location",
    "slices-by-order",
    "slices-missing",
    "slices-off-steps",
    "slices-straightened",
    "slices-uneven",
    "slope-not-finite",
    "space-differs",
    "space-las",
    "spacing-given",
    "trace-cut",
    "trace-without-slices",
    "unit-converted",
    "unit-of-file",
    "wide-integers",
};

// One of kCodes. Another name does not compile.
class Code {
 public:
  constexpr Code() = default;
  consteval Code(const char* name) : number_(number_of(name)) {}
  constexpr std::size_t number() const { return number_; }
  constexpr std::string_view name() const { return kCodes[number_]; }
  friend constexpr bool operator==(Code, Code) = default;

 private:
  static consteval std::size_t number_of(std::string_view name) {
    std::size_t number = 0;
    while (kCodes[number] != name) ++number;  // beyond the end: no constant
    return number;
  }
  std::size_t number_ = 0;
};

struct Diagnostic {
  Severity severity = Severity::note;
  Code code;
  std::string words;  // one line, without the file's name
  std::string file;   // that it is about, as the user gave it; or empty
  std::vector<std::pair<std::string_view, double>> values{};  // the names are literals

  // Gives the value that name.
  Diagnostic& with(std::string_view name, double value);
};
using Diagnostics = std::vector<Diagnostic>;

// Returns "file: words" in one line.
std::string text_of(const Diagnostic& diagnostic);

// Adds an item, unless the list has it. Returns the one in the list.
Diagnostic& add_to(Diagnostics& list, Diagnostic item);
Diagnostic& add_note(Diagnostics& list, Code code, const std::string& file, const auto&... words) {
  return add_to(list, {Severity::note, code, text(words...), file});
}
Diagnostic& add_warning(Diagnostics& list, Code code, const std::string& file,
                        const auto&... words) {
  return add_to(list, {Severity::warning, code, text(words...), file});
}

bool has(const Diagnostics& list, Code code);

}  // namespace deliso
