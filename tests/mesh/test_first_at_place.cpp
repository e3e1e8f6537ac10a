// SPDX-License-Identifier: MIT
#include "mesh/first_at_place.h"

#include <doctest/doctest.h>

#include <limits>

#include "base/random.h"

using namespace deliso;

TEST_CASE("the first point at each position is that of a look at all points before") {
  Random random(1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Vec3> points{{0.0, 1, 2}, {-0.0, 1, 2}, {nan, 0, 0}, {nan, 0, 0}, {0, nan, 0}};
  for (int n = 0; n < 2000; ++n) {
    // Round numbers and such that differ in the last bit.
    const auto place = [&] { return 1.0 * random.below(8) + 0x1p-50 * random.below(2); };
    points.push_back({place(), place(), place()});
  }
  const std::vector<VertexId> first = first_at_place(points);
  const auto is_same = [](const Vec3& p, const Vec3& q) {
    bool same = true;
    for (int axis = 0; axis < 3; ++axis) {
      same &= p[axis] == q[axis] || (p[axis] != p[axis] && q[axis] != q[axis]);
    }
    return same;
  };
  std::size_t again = 0;
  for (VertexId v = 0; v < points.size(); ++v) {
    VertexId expected = 0;
    while (!is_same(points[expected], points[v])) ++expected;
    CHECK(first[v] == expected);
    again += expected != v;
  }
  CHECK(again > 100);
  CHECK(first_at_place({}).empty());
}
