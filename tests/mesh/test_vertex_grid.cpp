// SPDX-License-Identifier: MIT
// The grid against a look at every vertex, while vertices come, move and go.
#include <doctest/doctest.h>

#include <set>
#include <vector>

#include "base/random.h"
#include "mesh/vertex_grid.h"

using namespace deliso;

TEST_CASE("every vertex within the radius is visited, and none twice") {
  Random random(5);
  for (const Vec3 size : {Vec3{9, 7, 5}, Vec3{4, 0, 30}, Vec3{0, 0, 0}}) {
    for (const double cell : {0.01, 0.5, 100.0}) {
      const Box3 box{{-1, 2, 0}, Vec3{-1, 2, 0} + size};
      const auto anywhere = [&] {  // a little outside, too
        return Vec3{box.lo.x + random.uniform(-0.1, 1.1) * size.x,
                    box.lo.y + random.uniform(-0.1, 1.1) * size.y,
                    box.lo.z + random.uniform(-0.1, 1.1) * size.z};
      };
      std::vector<Vec3> points(200);
      std::set<VertexId> present;
      VertexGrid grid(box, points.size(), cell);
      for (int step = 0; step < 2000; ++step) {
        const auto v = static_cast<VertexId>(random.below(200));
        if (present.erase(v) > 0) grid.remove(v, points[v]);
        if (random.below(4) != 0) {
          points[v] = anywhere();
          grid.add(v, points[v]);
          present.insert(v);
        }
        const Vec3 center = anywhere();
        const double radius = random.uniform(0, 3);
        std::multiset<VertexId> visited;
        CHECK_FALSE(grid.any_near(center, radius, [&](VertexId q) {
          visited.insert(q);
          return false;
        }));
        for (VertexId q = 0; q < points.size(); ++q) {
          const bool near = present.contains(q) && distance(points[q], center) <= radius;
          REQUIRE(visited.count(q) <= (present.contains(q) ? 1u : 0u));
          if (near) REQUIRE(visited.count(q) == 1);
        }
        if (!present.empty()) {
          const VertexId any = *present.begin();
          CHECK(grid.any_near(points[any], 0, [&](VertexId q) { return q == any; }));
        }
      }
    }
  }
}
