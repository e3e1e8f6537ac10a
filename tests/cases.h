// SPDX-License-Identifier: MIT
// How much a test does. `make test` looks at a tenth of the random cases and leaves out the slow
// test cases; `make test-all`, which sets DELISO_TEST_CASES=all, does everything. Under sanitizers
// all is ten times slower, and what they can find, they find in the first few of a kind.
#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

namespace deliso::test {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
inline constexpr bool kSanitized = __has_feature(address_sanitizer);
#else
inline constexpr bool kSanitized = false;
#endif

inline bool all_cases() {
  const char* cases = std::getenv("DELISO_TEST_CASES");
  return !kSanitized && cases && cases == std::string_view("all");
}

// The test case that runs: its file and line, as part of a file's name.
inline std::string case_name() {
  const doctest::detail::TestCase& test = *doctest::getContextOptions()->currentTest;
  return std::filesystem::path(test.m_file.c_str()).stem().string() + '-' +
         std::to_string(test.m_line);
}

// n or a tenth of it. For loops, and for what they must have met.
template <class Integer>
Integer cases(Integer n) {
  return all_cases() ? n : n / 10;
}

// n or a third of it, where cases take long and a tenth of more finds what all of them find.
template <class Integer>
Integer costly_cases(Integer n) {
  return all_cases() ? n : n / 3;
}

// TEST_CASE("..." * slow("why it takes over two seconds")): `make test-all` alone runs it.
struct slow {
  explicit slow(const char* why) : reason(why) {}
  void fill(doctest::detail::TestCase& test) const {
    test.m_skip = !all_cases();
    test.m_description = reason;
  }
  const char* reason;
};

}  // namespace deliso::test
