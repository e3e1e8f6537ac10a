// SPDX-License-Identifier: MIT
// Four values on a line against the volume's own interpolant.
#include "volume/interpolant.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "base/random.h"
#include "volume/sampled.h"
#include "volume/volume_source.h"

using namespace deliso;

namespace {

// The same volume, with samples that are no numbers behind its own: one of them makes any sum none,
// whatever its weight.
template <class Sample>
Volume before_nan(const Volume& volume) {
  const auto count = static_cast<std::ptrdiff_t>(volume.sample_count());
  auto samples =
      std::make_shared<std::vector<Sample>>(2 * count, std::numeric_limits<Sample>::quiet_NaN());
  volume.visit([&](const auto* s) { std::copy(s, s + count, samples->begin()); });
  return {volume, reinterpret_cast<const std::byte*>(samples->data()), samples};
}

}  // namespace

TEST_CASE_TEMPLATE("four values on a line are those of the volume, outside the box too", Sample,
                   std::uint8_t, float) {
  constexpr double kKappa = 40.5;
  Random random(1);
  const Volume even =
      sampled<Sample>({9, 9, 9}, {0.5, 1, 2}, [&](int, int, int) { return random.below(256); });
  const Volume uneven = even.with_places({{{0, 1, 1.5, 3, 4, 7, 8, 8.5, 9}, {}, {}}}, "test");
  for (const Volume& all : {even, uneven}) {
    const Volume volume = before_nan<Sample>(samples_of(all, {{2, 0, 3}, {5, 4, 8}}));
    const Interpolant g(volume, kKappa);
    const auto point = [&](double beyond) {
      const Box3 box = volume.box();
      return Vec3{random.uniform(box.lo.x - beyond, box.hi.x + beyond),
                  random.uniform(box.lo.y - beyond, box.hi.y + beyond),
                  random.uniform(box.lo.z - beyond, box.hi.z + beyond)};
    };
    for (int turn = 0; turn < 200; ++turn) {
      // The last point is the box's last corner, at the end of its last voxel.
      const Vec3 from = point(0.7), along = volume.box().hi - from;
      const Interpolant::Four t{0, random.uniform(), -random.uniform(), 1};
      const Interpolant::Four values = g.on_line(from, along, t);
      for (std::size_t n = 0; n < 4; ++n) {
        const double expected = volume.value(from + t[n] * along) - kKappa;
        CHECK(values[n] == doctest::Approx(expected).epsilon(1e-9));
      }
    }
  }
}
