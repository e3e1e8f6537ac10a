// SPDX-License-Identifier: MIT
// Three kinds of failure. Bad input throws InputError. A broken invariant trips DELISO_CHECK
// (always on) or DELISO_ASSERT (debug builds). A normal outcome is a return value.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/text.h"

#ifdef __FAST_MATH__
#error "DelIso's predicates need IEEE arithmetic: build without -ffast-math"
#endif

namespace deliso {

// Returns `message` as one line of bounded length, because files may hold any name or word. Control
// characters, and bytes that are no UTF-8, become '?': a terminal would obey the former. The middle
// of a very long message is left out.
inline std::string one_line(std::string message) {
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

// Thrown for unusable input. what() is one line that names the file and the fault. It is made of
// pieces, as by text().
struct InputError : std::runtime_error {
  explicit InputError(const auto&... message) : std::runtime_error(one_line(text(message...))) {}
};

[[noreturn]] inline void check_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "deliso: internal error: %s does not hold (%s:%d)\n", condition, file, line);
  std::abort();
}

}  // namespace deliso

#define DELISO_CHECK(condition) \
  ((condition) ? void(0) : ::deliso::check_failed(#condition, __FILE__, __LINE__))
#ifdef NDEBUG
#define DELISO_ASSERT(condition) void(0)
#else
#define DELISO_ASSERT(condition) DELISO_CHECK(condition)
#endif
