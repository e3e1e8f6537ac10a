// SPDX-License-Identifier: MIT
// printf into a string, for columns of text. For other text, text.h is simpler.
#pragma once

#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <string>

namespace deliso {

[[gnu::format(printf, 2, 3)]] inline void append_format(std::string& text, const char* format,
                                                        ...) {
  va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  const int size = std::vsnprintf(nullptr, 0, format, arguments);
  va_end(arguments);
  if (size > 0) {
    const std::size_t before = text.size(), added = static_cast<std::size_t>(size);
    text.resize(before + added + 1);  // vsnprintf ends with a null character
    std::vsnprintf(text.data() + before, added + 1, format, again);
    text.pop_back();
  }
  va_end(again);
}

}  // namespace deliso
