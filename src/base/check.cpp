// SPDX-License-Identifier: MIT
#include "base/check.h"

#include <string_view>

namespace deliso {

std::string one_line(std::string message) {
  constexpr std::size_t kBegin = 200, kEnd = 300;
  if (message.size() > kBegin + kEnd) {
    message.replace(kBegin, message.size() - kBegin - kEnd, "[...]");
  }
  std::string line;
  for (std::string_view rest = message; !rest.empty();) {
    const std::size_t length = utf8_length(rest);
    if (length == 0 || is_control(rest.substr(0, length))) {
      line += '?';
    } else {
      line += rest.substr(0, length);
    }
    rest.remove_prefix(length == 0 ? 1 : length);
  }
  return line;
}

InputError::InputError(std::initializer_list<TextPiece> message)
    : std::runtime_error(one_line(joined(message))) {}

void check_failed(const char* condition, const char* file, int line) {
  throw InternalError(
      text("internal error: ", condition, " does not hold (", file, ":", line, ")"));
}

}  // namespace deliso
