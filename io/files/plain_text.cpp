// SPDX-License-Identifier: MIT
#include "io/files/plain_text.h"

#include <algorithm>
#include <cstddef>

#include "base/text.h"

namespace deliso {

std::string plain_comment(std::string comment) {
  for (std::size_t i = 0; i < comment.size(); ++i) {
    const char c = comment[i];
    const bool twice = c == '-' && i > 0 && comment[i - 1] == '-';
    if (c < ' ' || c > '~' || c == '\\' || twice) comment[i] = '?';
  }
  return comment;
}

std::string plain_name(std::string_view name) {
  std::string result;
  while (!name.empty()) {
    const std::size_t length = utf8_length(name);
    const bool is_control = name[0] == '\x7f' || (name[0] >= 0 && name[0] < ' ');
    result += length == 0 || is_control ? "?" : name.substr(0, length);
    name.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

}  // namespace deliso
