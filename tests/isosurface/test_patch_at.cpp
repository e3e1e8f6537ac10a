// SPDX-License-Identifier: MIT
// Points of Sigma along lines by the patch of one voxel, against the walk over voxels.
#include "isosurface/patch_at.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/random.h"

using namespace deliso;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void agrees(const Volume& volume, Random& random) {
  const Isosurface surface(volume, 0.5);
  const Vec3 margin{0.1, 0.1, 0.1};
  const Box3 box = Box3{volume.box().lo - margin, volume.box().hi + margin};
  SearchCounters patches, walks;
  int own = 0;
  for (int n = 0; n < 20000; ++n) {
    Vec3 p, direction;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = box.lo[axis] + random.uniform() * box.size()[axis];
      direction[axis] = n % 7 == axis ? 0 : 2 * random.uniform() - 1;
    }
    const PatchAt patch(surface, p);
    CHECK(distance(patch.gradient(), surface.gradient(p)) < 1e-12);
    if (n % 3 == 0) direction = patch.gradient();
    const double limit = n % 2 == 0 ? 3 : 0.2;
    const double d = std::fabs(patch.parameter_along(direction, limit, patches));
    const Vec3 unit = direction / length(direction);
    const auto found = patch.nearest(unit, limit, patches);
    const auto hit = surface.nearest(p, unit, limit, walks);
    REQUIRE(found.has_value() == hit.has_value());
    REQUIRE(std::isfinite(d) == hit.has_value());
    if (!hit) continue;
    CHECK(std::fabs(d - std::fabs(hit->t)) < 1e-9);
    CHECK(distance(found->point, hit->point) < 1e-9);
    CHECK(std::fabs(volume.value(found->point) - surface.kappa()) < 1e-9);
    CHECK(found->leaves == hit->leaves);
    own += found->t != hit->t;  // not from a walk: rounded otherwise
  }
  CHECK(walks.searches_with_hit > 1000);
  CHECK(patches.searches == 2 * walks.searches);
  CHECK(patches.searches_with_hit == 2 * walks.searches_with_hit);
  CHECK(own > 1000);
  const PatchAt patch(surface, {4, 2, 6});
  SearchCounters counters;
  CHECK(patch.parameter_along({0, 0, 0}, 9, counters) == kInfinity);
  CHECK(patch.parameter_along({kInfinity, 0, 0}, 9, counters) == kInfinity);
}

}  // namespace

TEST_CASE("a patch finds the point of Sigma that the oracle finds") {
  Random random(7);
  std::vector<float> samples(9 * 8 * 7);
  for (float& sample : samples) sample = static_cast<float>(random.uniform());
  const Volume even = Volume::from_samples({9, 8, 7}, {1, 0.5, 2}, samples);
  agrees(even, random);
  agrees(even.with_places({{{}, {}, {0, 1, 3, 3.5, 6, 8, 12}}}, "test"), random);
}
