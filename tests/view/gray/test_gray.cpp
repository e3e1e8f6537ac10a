// SPDX-License-Identifier: MIT
// Windows against sorted samples, the filled cut against the interpolant.
#include "view/gray/gray.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "base/random.h"

using namespace deliso;

TEST_CASE("a window holds all samples but outliers and padding") {
  Random random(3);
  std::vector<float> samples(20 * 20 * 20, -3024.0F);  // padding, of which half is left
  for (std::size_t n = 0; n < samples.size(); n += 2) {
    samples[n] = static_cast<float>(random.uniform(-100, 100));
  }
  samples[7] = 1e30F;
  const Volume volume = Volume::from_samples({20, 20, 20}, {1, 1, 1}, samples);
  const GrayWindow window = gray_window(volume, value_range(volume));
  CHECK(std::abs(window.lo + 99) < 1);
  CHECK(std::abs(window.hi - 99) < 1);
  CHECK(window.gray(window.lo) == 0);
  CHECK(window.gray(window.hi) == 1);
  CHECK(window.gray(-3024) == 0);
  CHECK(window.gray(0.5 * (window.lo + window.hi)) == doctest::Approx(0.5));
}

TEST_CASE("few values, one value and values too far apart have a window too") {
  const Volume mask =
      Volume::from_samples<std::uint8_t>({2, 2, 2}, {1, 1, 1}, {0, 1, 1, 0, 0, 0, 1, 1});
  CHECK(gray_window(mask, value_range(mask)).gray(1) == 1);
  CHECK(gray_window(mask, value_range(mask)).gray(0) == 0);
  const Volume flat = Volume::from_samples({2, 2, 2}, {1, 1, 1}, std::vector<double>(8, 5.0));
  CHECK(gray_window(flat, value_range(flat)).gray(5) == 0.5);
  constexpr double kMost = std::numeric_limits<double>::max();
  const GrayWindow widest{-kMost, kMost};
  CHECK(widest.gray(0) == 0.5);
  CHECK(widest.gray(kMost) == 1);
}

TEST_CASE("a cut has the interpolant's gray inside the surface and is open elsewhere") {
  Random random(5);
  std::vector<double> samples;
  for (int n = 0; n < 5 * 4 * 3; ++n) samples.push_back(random.uniform());
  const double c = std::cos(0.3), s = std::sin(0.3);
  const Frame frame{{10, -20, 30}, {Vec3{c, s, 0}, Vec3{s, -c, 0}, Vec3{0, 0, 1}}};
  const Volume volume = Volume::from_samples({5, 4, 3}, {0.5, 1, 2}, samples, frame);
  const GrayWindow window{0.2, 0.9};
  const auto gray = gray_inside(Volume(volume), 0.4, window);  // outlives the one given
  int inside = 0, outside = 0;
  for (int n = 0; n < 2000; ++n) {
    const Vec3 p{random.uniform(0, 2), random.uniform(0, 3), random.uniform(0, 4)};
    const double value = volume.value(p);
    if (std::abs(value - 0.4) < 1e-9) continue;
    const std::optional<double> seen = gray(frame.to_world(p));
    REQUIRE(seen.has_value() == (value > 0.4));
    (seen ? inside : outside) += 1;
    if (seen) CHECK(*seen == doctest::Approx(window.gray(value)).epsilon(1e-9));
  }
  CHECK(std::min(inside, outside) > 200);
  for (const Vec3& beyond : {Vec3{-0.01, 1, 1}, Vec3{1, 3.01, 1}, Vec3{1, 1, 4.01}}) {
    CHECK_FALSE(gray(frame.to_world(beyond)).has_value());
  }
}
