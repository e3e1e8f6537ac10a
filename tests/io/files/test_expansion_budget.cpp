// SPDX-License-Identifier: MIT
#include "io/files/expansion_budget.h"

#include <doctest/doctest.h>

#include <cstdint>

using namespace deliso;

TEST_CASE("a budget of expansion grows with the file, and does not overflow") {
  const ExpansionBudget budget{.free_bytes = 100, .ratio = 10};
  CHECK_NOTHROW(budget.require("f", 0, 100));
  CHECK_NOTHROW(budget.require("f", 5, 149));
  CHECK_THROWS_WITH_AS(
      budget.require("f", 5, 150),
      "f: has 5 bytes, which would become 150 or more in memory: over 100, at most "
      "10 for each are made",
      InputError);
  CHECK_NOTHROW(budget.require("f", UINT64_MAX, UINT64_MAX));
  CHECK_THROWS_AS(budget.require("f", 1, UINT64_MAX), InputError);
  CHECK_NOTHROW(ExpansionBudget().require("f", 1, std::uint64_t{256} << 20));
  CHECK_THROWS_AS(ExpansionBudget().require("f", 330'000, 5'100'000'000), InputError);
}
