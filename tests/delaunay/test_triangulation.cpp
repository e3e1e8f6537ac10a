// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "base/random.h"
#include "delaunay/check_triangulation.h"
#include "delaunay/predicates.h"
#include "delaunay/triangulation.h"

using namespace deliso;

TEST_CASE("random, grid, sphere: brute force finds nothing") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    std::vector<Vec3> points;
    const int n = 8 + static_cast<int>(random.below(150));
    for (int i = 0; i < n; ++i) {
      Vec3 p{random.uniform(), random.uniform(), random.uniform()};
      if (seed % 3 == 1)
        p = {double(random.below(5)), double(random.below(5)), double(random.below(5))};
      if (seed % 3 == 2) p = p / length(p);
      points.push_back(p);
    }
    Triangulation t;
    std::vector<VertexId> ids;
    REQUIRE(t.build(points, ids));
    for (int i = 0; i < n; ++i) CHECK(t.point(ids[i]) == points[i]);
    REQUIRE(check_triangulation(t) == "");
    REQUIRE(check_delaunay(t) == "");
  }
}
