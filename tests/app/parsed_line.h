// SPDX-License-Identifier: MIT
// Command lines from one text.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "app/command_line.h"

namespace deliso::test {

// The words of a line; '' is an empty one, and ~ a blank within one.
inline std::vector<std::string> split(std::string_view line) {
  std::vector<std::string> words;
  for (std::size_t at = 0, end; at < line.size(); at = end + 1) {
    end = std::min(line.find(' ', at), line.size());
    std::string word(line.substr(at, end - at));
    std::ranges::replace(word, '~', ' ');
    words.push_back(word == "''" ? "" : word);
  }
  return words;
}

inline CommandLine parse_words(const std::vector<std::string>& words) {
  return parse_command_line(std::vector<std::string_view>(words.begin(), words.end()));
}
inline CommandLine parsed(std::string_view line) {
  return parse_words(split(line));
}

// The lines of a run's warnings, but for those of a code.
inline std::vector<std::string> warnings_of(const Diagnostics& notes,
                                            std::string_view but_for = {}) {
  std::vector<std::string> lines;
  for (const Diagnostic& item : notes) {
    const bool is_meant = item.severity == Severity::warning && item.code.name() != but_for;
    if (is_meant) lines.push_back(text_of(item));
  }
  return lines;
}

}  // namespace deliso::test
