// SPDX-License-Identifier: MIT
// The volumes that spheres bound, whole or cut by the box, against the formula.
#include "check/bounded_volume.h"
#include "volume/sampled.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace deliso;

namespace {

constexpr int kSamples = 33;

constexpr Index3 kCube{kSamples, kSamples, kSamples};

}  // namespace

TEST_CASE(
    "the volume of a sphere, whole or cut by the box, has the formula's value and the right sign") {
  constexpr double kRadius = 9.3, kMiddle = 16.1, kEnd = kSamples - 1;
  const double sphere = 4.0 / 3 * std::numbers::pi * kRadius * kRadius * kRadius;
  struct Case {
    Vec3 center;
    double share;
  };
  for (const Case& c : {Case{{kMiddle, kMiddle, kMiddle}, 1}, Case{{0, kMiddle, kMiddle}, 0.5},
                        Case{{kMiddle, kEnd, 0}, 0.25}, Case{{kEnd, 0, kEnd}, 0.125}}) {
    CAPTURE(c.share);
    for (const double sign : {1.0, -1.0}) {  // a ball, or a hole
      CAPTURE(sign);
      const Volume volume = sampled<float>(kCube, {1, 1, 1}, [&](int i, int j, int k) {
        const Vec3 p{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        return sign * (kRadius - distance(p, c.center));
      });
      const ContourMesh contour = build_contour(volume, 0);
      const auto origins = component_origins(contour, volume.box());
      REQUIRE(origins.size() == 1);
      REQUIRE(origins[0]);
      const auto volumes =
          bounded_volumes(contour.points, contour.triangles, contour.component, origins);
      CHECK(volumes[0] / 6 == doctest::Approx(sign * c.share * sphere).epsilon(0.01));
    }
  }
}

TEST_CASE("a component that meets opposite faces of the box has no volume of its own") {
  const Volume volume = sampled<float>(
      kCube, {1, 1, 1}, [](int i, int j, int) { return 5 - std::hypot(i - 12, j - 15); });
  const ContourMesh contour = build_contour(volume, 0);
  const auto origins = component_origins(contour, volume.box());
  REQUIRE(origins.size() == 1);
  CHECK_FALSE(origins[0]);
  CHECK(bounded_volumes(contour.points, contour.triangles, contour.component, origins)[0] == 0);
}
