// SPDX-License-Identifier: MIT
// A program's peak of memory is its own, whoever starts it.
#include "app/peak_memory.h"

#include <doctest/doctest.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cstddef>
#include <vector>

using namespace deliso;

namespace {
constexpr std::size_t kHeld = std::size_t{512} << 20;
}

// Run by the next test, in a program of its own.
TEST_CASE("started by a large program" * doctest::skip()) {
  CHECK(peak_memory_bytes() > kHeld / 512);
  CHECK(peak_memory_bytes() < kHeld / 2);
}

TEST_CASE("memory of the program that starts another is not the other's") {
  const std::vector<char> held(kHeld, 'x');
  CHECK(peak_memory_bytes() > kHeld);
  char name[] = "test", skipped[] = "--no-skip", test[] = "--test-case=started by a large program";
  char* const arguments[] = {name, skipped, test, nullptr};
  pid_t child = 0;
  REQUIRE(posix_spawn(&child, "/proc/self/exe", nullptr, nullptr, arguments, environ) == 0);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(status == 0);
  CHECK(held.back() == 'x');
}
