// SPDX-License-Identifier: MIT
// Three kinds of failure. Bad input throws InputError. A broken invariant trips DELISO_CHECK
// (always on) or DELISO_ASSERT (debug builds), which throws InternalError. A normal outcome is a
// return value.
#pragma once

#include <stdexcept>
#include <string>

#include "base/text.h"

#ifdef __FAST_MATH__
#error "DelIso's predicates need IEEE arithmetic: build without -ffast-math"
#endif

namespace deliso {

// Returns `message` as one line of bounded length, because files may hold any name or word. Control
// characters become '?'; the middle of a very long message is left out.
inline std::string one_line(std::string message) {
  constexpr std::size_t kBegin = 200, kEnd = 300;
  if (message.size() > kBegin + kEnd) {
    message.replace(kBegin, message.size() - kBegin - kEnd, "[...]");
  }
  for (char& c : message) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return message;
}

// Thrown for unusable input. what() is one line that names the file and the fault. It is made of
// pieces, as by text().
struct InputError : std::runtime_error {
  explicit InputError(const auto&... message) : std::runtime_error(one_line(text(message...))) {}
};

// Thrown where an invariant is broken: by an error of the library, or by samples that changed while
// they were meshed. Nobody goes on after it: the program ends, and a call of the C library fails.
struct InternalError : std::logic_error {
  using std::logic_error::logic_error;
};

[[noreturn, gnu::cold, gnu::noinline]] inline void check_failed(const char* condition,
                                                                const char* file, int line) {
  throw InternalError(
      text("internal error: ", condition, " does not hold (", file, ":", line, ")"));
}

}  // namespace deliso

#define DELISO_CHECK(condition) \
  ((condition) ? void(0) : ::deliso::check_failed(#condition, __FILE__, __LINE__))
#ifdef NDEBUG
#define DELISO_ASSERT(condition) void(0)
#else
#define DELISO_ASSERT(condition) DELISO_CHECK(condition)
#endif
