// SPDX-License-Identifier: MIT
// How many random cases a test looks at. Sanitizers make code ten times slower, and what they can
// find, they find in the first few of a kind.
#pragma once

namespace deliso::test {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
inline constexpr bool kSanitized = __has_feature(address_sanitizer);
#else
inline constexpr bool kSanitized = false;
#endif

// A tenth of n under sanitizers. For loops, and for what they must have met.
template <class Integer>
constexpr Integer cases(Integer n) {
  return kSanitized ? n / 10 : n;
}

}  // namespace deliso::test
