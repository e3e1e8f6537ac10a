// SPDX-License-Identifier: MIT
// Three kinds of failure. Bad input throws InputError. A broken invariant trips DELISO_CHECK
// (always on) or DELISO_ASSERT (debug builds), which throws InternalError. A normal outcome is a
// return value.
#pragma once

#include <initializer_list>
#include <stdexcept>
#include <string>

#include "base/text.h"

#ifdef __FAST_MATH__
#error "DelIso's predicates need IEEE arithmetic: build without -ffast-math"
#endif

namespace deliso {

// Returns `message` as one line of bounded length, because files may hold any name or word. Control
// characters, and bytes that are no UTF-8, become '?': a terminal would obey the former. The middle
// of a very long message is left out.
std::string one_line(std::string message);

// Thrown for unusable input. what() is one line that names the file and the fault. It is made of
// pieces, as by text().
struct InputError : std::runtime_error {
  [[gnu::cold]] explicit InputError(const auto&... message)
      : InputError({text_piece(message)...}) {}

 private:
  explicit InputError(std::initializer_list<TextPiece> message);
};

// Thrown where an invariant is broken: by an error of the library, or by samples that changed while
// they were meshed. Nobody goes on after it: the program ends, and a call of the C library fails.
struct InternalError : std::logic_error {
  using std::logic_error::logic_error;
};

[[noreturn, gnu::cold]] void check_failed(const char* condition, const char* file, int line);

}  // namespace deliso

#define DELISO_CHECK(condition) \
  ((condition) ? void(0) : ::deliso::check_failed(#condition, __FILE__, __LINE__))
#ifdef NDEBUG
#define DELISO_ASSERT(condition) void(0)
#else
#define DELISO_ASSERT(condition) DELISO_CHECK(condition)
#endif
