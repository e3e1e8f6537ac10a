// SPDX-License-Identifier: MIT
#include "base/check.h"

namespace deliso {

std::string one_line(std::string message) {
  constexpr std::size_t kBegin = 200, kEnd = 300;
  if (message.size() > kBegin + kEnd) {
    message.replace(kBegin, message.size() - kBegin - kEnd, "[...]");
  }
  for (char& c : message) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return message;
}

InputError::InputError(std::initializer_list<TextPiece> message)
    : std::runtime_error(one_line(joined(message))) {}

}  // namespace deliso
