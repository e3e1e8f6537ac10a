// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <vector>

#include "base/random.h"
#include "check/place_faults.h"
#include "embedding/all_crossings.h"

using namespace deliso;

namespace {

std::size_t crossings(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  return find_place_faults(points, triangles).crossings;
}

}  // namespace

TEST_CASE("find_place_faults counts the crossings that brute force finds among random triangles") {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    for (std::uint32_t v = 0; v < 90; v += 3) {
      const Vec3 at{random.uniform(0, 3), random.uniform(0, 3), random.uniform(0, 3)};
      for (int n = 0; n < 3; ++n) {
        points.push_back(at + Vec3{random.uniform(), random.uniform(), random.uniform()});
      }
      triangles.push_back(triangle_of(v, v + 1, v + 2));
    }
    CAPTURE(seed);
    CHECK(crossings(points, triangles) == test::all_crossings(points, triangles).size());
  }
}

// Rounding to float merges vertices: triangles that then touch at a corner do not cross.
TEST_CASE("vertices at one position count as one, and facets that name one twice are ignored") {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0},  {0, 1, 0},
                                 {0, 0, 0}, {-1, 0, 1}, {0, -1, 1}};
  CHECK(crossings(points, {{0, 1, 2}, {3, 4, 5}}) == 0);
  CHECK(crossings(points, {{0, 1, 2}, {3, 4, 5}, {0, 3, 1}}) == 0);
  std::vector<Vec3> apart = points;
  apart[3] = {0.1, 0.1, 0};
  CHECK(crossings(apart, {{0, 1, 2}, {3, 4, 5}}) == 1);
}
