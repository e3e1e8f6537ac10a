// SPDX-License-Identifier: MIT
// What a failing CHECK shows of the project's own types.
#include <doctest/doctest.h>

#include <array>
#include <optional>
#include <vector>

#include "base/topology_counts.h"
#include "base/vec3.h"

using namespace deliso;

TEST_CASE("a failing CHECK shows values of our own types, not {?}") {
  CHECK(doctest::toString(TopologyCounts{1, -2, 3}) ==
        "1 components, Euler number -2, 3 boundary loops");
  CHECK(doctest::toString(Vec3{1, 2, 3.5}) == "(1, 2, 3.5)");
  CHECK(doctest::toString(std::vector<std::optional<int>>{4, std::nullopt}) == "2 {4, nothing}");
  CHECK(doctest::toString(std::array<int, 20>{}) == "20 {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 ...}");
}
