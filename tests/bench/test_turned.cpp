// SPDX-License-Identifier: MIT
// The turns are the 24 of a cube: no two are alike, and none is a mirror image.
#include "support/turned.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <vector>

using namespace deliso;

TEST_CASE("a volume is turned in 24 ways, and never mirrored") {
  // The corner, and the far ends of the three edges at it.
  std::vector<float> samples(2 * 3 * 4, 0);
  const Index3 dims{2, 3, 4};
  samples[0] = 1, samples[1] = 2, samples[2 * 2] = 3, samples[2 * 3 * 3] = 4;
  const Volume volume = Volume::from_samples(dims, {1, 10, 100}, samples);
  std::set<std::vector<float>> seen;
  for (std::uint64_t n = 0; n < kTurns; ++n) {
    CAPTURE(n);
    const Volume after = turned(volume, n);
    REQUIRE(after.sample_count() == samples.size());
    std::vector<float> values{static_cast<float>(after.dims().i),
                              static_cast<float>(after.dims().j)};
    Vec3 place[5];
    for (int k = 0; k < after.dims().k; ++k) {
      for (int j = 0; j < after.dims().j; ++j) {
        for (int i = 0; i < after.dims().i; ++i) {
          const auto value = after.sample(i, j, k);
          values.push_back(static_cast<float>(value));
          place[static_cast<int>(value)] = {i * after.spacing().x, j * after.spacing().y,
                                            k * after.spacing().z};
        }
      }
    }
    if (n == 0) CHECK(std::equal(samples.begin(), samples.end(), values.begin() + 2));
    seen.insert(values);
    const Vec3 x = place[2] - place[1], y = place[3] - place[1], z = place[4] - place[1];
    CHECK(dot(cross(x, y), z) == 1 * 20 * 300);
  }
  CHECK(seen.size() == kTurns);
}
