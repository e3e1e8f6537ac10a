// SPDX-License-Identifier: MIT
#include "io/mesh/to_float.h"

#include <doctest/doctest.h>

#include <vector>

#include "base/random.h"

using namespace deliso;

TEST_CASE("every coordinate is rounded, also by a compiler that vectorizes") {
  Random random(5);
  std::vector<Vec3> points, rounded;
  for (int n = 0; n < 100; ++n) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = random.uniform(-1e6, 1e6);
    points.push_back(p);
  }
  for (const Vec3& p : points) rounded.push_back(to_float(p));
  for (std::size_t n = 0; n < points.size(); ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      const volatile float x = static_cast<float>(points[n][axis]);
      CHECK(rounded[n][axis] == x);
    }
    CHECK(rounded[n] != points[n]);
  }
}
