// SPDX-License-Identifier: MIT
// Facets over a slab, whose other side is near.
#include "surface/facet_test.h"

#include <doctest/doctest.h>

#include <cmath>

#include "volume/sampled.h"

using namespace deliso;

namespace {

// The solid between the planes z = 4.3 and z = 5.7.
const Volume kSlab =
    sampled<float>({11, 11, 11}, {1, 1, 1}, [](int, int, int k) { return 0.7 - std::abs(k - 5); });

// Returns whether a facet of this circumradius has the surface near at this height over the upper
// plane.
bool has_surface_near(double r, double height, double bound) {
  Parameters p{};
  p.voxel = 1;
  p.r_min = 0.25;
  p.refinement[Criterion::r_over_l] = 2;
  const double z = 5.7 + height, half = r * std::sqrt(0.75);
  const Vec3 a{5 + r, 5, z}, b{5 - 0.5 * r, 5 + half, z}, c{5 - 0.5 * r, 5 - half, z};
  return FacetTest(kSlab, 0, p, bound).has_surface_near(FacetTest::Facet(a, b, c), r * r);
}

}  // namespace

TEST_CASE("a larger bound refuses no facet for the sheet behind it") {
  for (const double bound : {0.1, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0}) {
    CAPTURE(bound);
    CHECK(has_surface_near(0.6, 0, bound));
    CHECK(has_surface_near(1.2, 0, bound));
    CHECK_FALSE(has_surface_near(1.6, 0, bound));  // the other sheet is in its ball
  }
}

TEST_CASE("the bound is asked within a facet's ball, and half a voxel beyond a smaller one") {
  CHECK(has_surface_near(1.2, 0.3, 0.31));
  CHECK_FALSE(has_surface_near(1.2, 0.3, 0.29));
  CHECK(has_surface_near(1.2, 0.3, 3));
  CHECK_FALSE(has_surface_near(0.6, 0.55, 3));  // beyond its ball
}
