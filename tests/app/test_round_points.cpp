// SPDX-License-Identifier: MIT
// The rounding that avoids faults by place, of triangles where they are known.
#include "app/round_points.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "base/random.h"
#include "check/place_faults.h"
#include "io/mesh/to_float.h"

using namespace deliso;

namespace {

using Triangles = std::vector<Triangle>;

// Two triangles, the second above the first by `gap` where the first is at x = 1000.
std::vector<Vec3> sheets(double gap) {
  return {{1000, 0, 0},       {1001, 0, 0},       {1000, 1, 0},
          {1000 + gap, 0, 0}, {1000 + gap, 1, 1}, {1000 + gap, -1, 1}};
}

}  // namespace

TEST_CASE("points without faults are rounded to the nearest float") {
  Random random(3);
  std::vector<Vec3> points;
  for (int n = 0; n < 30; ++n) {
    points.push_back({random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)});
  }
  const std::vector<Vec3> rounded = round_without_faults(points, Triangles{{0, 1, 2}}, 1);
  for (std::size_t v = 0; v < points.size(); ++v) CHECK(rounded[v] == to_float(points[v]));
}

TEST_CASE("where rounding makes faults, other floats around the exact place are taken") {
  const Triangles two{{0, 1, 2}, {3, 4, 5}};
  // Floats at 1000 are 6e-5 apart, so both sheets round to one place.
  const std::vector<Vec3> exact = sheets(-2e-5);
  CHECK(find_place_faults(exact, two, 1).count() == 0);
  std::vector<Vec3> rounded;
  for (const Vec3& p : exact) rounded.push_back(to_float(p));
  CHECK(find_place_faults(rounded, two, 1).count() > 0);

  const std::vector<Vec3> mended = round_without_faults(exact, two, 1);
  CHECK(find_place_faults(mended, two, 1).count() == 0);
  for (std::size_t v = 0; v < exact.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      const double x = exact[v][axis];
      CHECK(to_float(mended[v][axis]) == mended[v][axis]);
      // A float stays; others go to one of the two floats around them.
      const double most = to_float(x) == x ? 0 : std::ldexp(1.0, std::ilogb(x) - 23);
      CHECK(std::fabs(mended[v][axis] - x) <= most);
    }
  }
}

TEST_CASE("vertices that are all floats cannot be mended") {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}};
  CHECK(round_without_faults(points, Triangles{{0, 1, 2}}, 1) == points);
  // Nor can those of no triangle.
  CHECK(round_without_faults({{1, 0, 0}, {1, 0, 0}}, {}, 1).size() == 2);
}
