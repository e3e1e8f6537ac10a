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

}  // namespace deliso::test
