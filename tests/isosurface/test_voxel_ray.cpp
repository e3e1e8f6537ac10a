// SPDX-License-Identifier: MIT
// The cubic that a line sees in a voxel (V1 and V2 of isosurface/voxel_ray.h), against the patch.
#include "isosurface/voxel_ray.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"

using namespace deliso;

namespace {

Corners random_corners(Random& random, double lo, double hi) {
  Corners c;
  for (double& value : c) value = random.uniform(lo, hi);
  return c;
}

Vec3 random_point(Random& random) {
  return {random.uniform(), random.uniform(), random.uniform()};
}

double patch_at(const Corners& c, const Vec3& p) {
  double sum = 0;
  for (std::size_t m = 0; m < 8; ++m) {
    sum += c[m] * ((m & 1) != 0 ? p.x : 1 - p.x) * ((m & 2) != 0 ? p.y : 1 - p.y) *
           ((m & 4) != 0 ? p.z : 1 - p.z);
  }
  return sum;
}

double bernstein(const Cubic& b, double t) {
  const double u = 1 - t;
  return u * u * u * b[0] + 3 * u * t * (u * b[1] + t * b[2]) + t * t * t * b[3];
}

}  // namespace

TEST_CASE("along any line the patch is the cubic") {
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 20'000; ++seed) {
    Random random(seed);
    const Corners c = random_corners(random, -1, 1);
    const Vec3 p = random_point(random), q = random_point(random);
    const Cubic b = patch_along(c, p, q);
    for (int n = 0; n <= 8; ++n) {
      const double t = n / 8.0;
      worst = std::max(worst, std::abs(bernstein(b, t) - patch_at(c, (1 - t) * p + t * q)));
    }
  }
  CHECK(worst < 4e-15);
}

TEST_CASE("corners on one side give coefficients on that side, so nothing is solved") {
  for (std::uint64_t seed = 1; seed <= 20'000; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const bool inside = seed % 2 == 0;
    Corners c = inside ? random_corners(random, 0, 1) : random_corners(random, -1, 0);
    for (double& value : c) {
      // The doubles nearest to zero, and zero itself, which is inside.
      if (random.below(4) == 0) value = inside ? 0 : -5e-324;
      if (random.below(4) == 0) value = std::ldexp(value, -static_cast<int>(random.below(900)));
      if (!inside && value == 0) value = -5e-324;
    }
    const Cubic b = patch_along(c, random_point(random), random_point(random));
    for (const double value : b) REQUIRE((value >= 0) == inside);
    REQUIRE(crossings(b, CubicMethod::isolation).count == 0);
  }
}

TEST_CASE("two voxels see the same value where they meet, to the last bit") {
  for (std::uint64_t seed = 1; seed <= 20'000; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    // Voxel b is beyond a's face at x = 1: they share four samples.
    const Corners a = random_corners(random, -1, 1);
    Corners b = random_corners(random, -1, 1);
    for (std::size_t m = 0; m < 8; m += 2) b[m] = a[m + 1];
    Vec3 leaves = random_point(random);
    leaves.x = 1;
    const Vec3 enters{0, leaves.y, leaves.z};
    const Cubic before = patch_along(a, random_point(random), leaves);
    const Cubic after = patch_along(b, enters, random_point(random));
    REQUIRE(before[3] == after[0]);
  }
}
