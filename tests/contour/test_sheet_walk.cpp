// SPDX-License-Identifier: MIT
// A sheet leads along the edges of T, and never from one component to another.
#include "contour/sheet_walk.h"

#include <doctest/doctest.h>

#include <cstdint>

#include "base/random.h"
#include "cases.h"
#include "contour/contour.h"
#include "stress/tiny_volume.h"
#include "volume/sampled.h"

using namespace deliso;

TEST_CASE("a sheet leads along every edge of T, and never to another component") {
  std::size_t led = 0, apart = 0;
  for (int trial = 0; trial < test::cases(400); ++trial) {
    CAPTURE(trial);
    const stress::TinyVolume tiny = stress::make_tiny_volume(static_cast<std::uint64_t>(trial));
    const double kappa = geometric_isovalue(tiny.volume.type(), tiny.isovalue);
    const ContourMesh contour = build_contour(tiny.volume, kappa);
    if (contour.points.empty()) continue;
    SheetWalk walk(tiny.volume, kappa);
    const auto& points = contour.points;
    for (const ContourTriangle& t : contour.triangles) {
      REQUIRE(walk.leads(points[t[0]], points[t[1]]));
      ++led;
    }
    Random random(static_cast<std::uint64_t>(trial));
    for (int n = 0; n < 200; ++n) {
      const auto count = static_cast<std::uint32_t>(points.size());
      const ContourId p(random.below(count)), q(random.below(count));
      if (contour.component[p] == contour.component[q]) continue;
      REQUIRE_FALSE(walk.leads(points[p], points[q]));
      ++apart;
    }
  }
  CHECK(led > 1000);
  CHECK(apart > 1000);
}

TEST_CASE("a way around that is longer than a voxel is no sheet") {
  // A plate of two samples, in the middle of which both sides are as far from its rim as can be.
  const Volume volume = sampled<std::uint8_t>({13, 13, 8}, {1, 1, 1}, [](int i, int j, int k) {
    return 2 <= i && i < 11 && 2 <= j && j < 11 && (k == 3 || k == 4) ? 100 : 0;
  });
  SheetWalk walk(volume, 50);
  const Vec3 below{6.25, 6.25, 2.5}, above{6.25, 6.25, 4.5};
  CHECK_FALSE(walk.leads(below, above));
  CHECK(walk.leads(below, {9.5, 7.5, 2.5}));
  // At the rim the way around is short.
  CHECK(walk.leads({10.25, 6.25, 2.5}, {10.25, 6.25, 4.5}));
}

TEST_CASE("of a point off the surface no sheet is known") {
  const Volume volume =
      sampled<std::uint8_t>({9, 9, 9}, {1, 1, 1}, [](int, int, int k) { return 100 * (k < 3); });
  SheetWalk walk(volume, 50);
  CHECK(walk.leads({4, 4, 6.5}, {4, 4, 2.5}));  // no point of Sigma
  CHECK(walk.leads({4, 4, -2}, {4, 4, 2.5}));   // outside
  CHECK_FALSE(walk.leads({4, 4, 2.5}, {4, 4, 6.5}));
}
