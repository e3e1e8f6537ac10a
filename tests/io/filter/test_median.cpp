// SPDX-License-Identifier: MIT
#include "io/filter/median.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "base/random.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

int mirrored(int i, int n) {
  while (i < 0 || i >= n) i = i < 0 ? -1 - i : 2 * n - 1 - i;
  return i;
}

template <class T>
T oracle(const std::vector<T>& samples, Index3 n, Index3 at, int radius) {
  std::vector<T> box;
  for (int k = at.k - radius; k <= at.k + radius; ++k) {
    for (int j = at.j - radius; j <= at.j + radius; ++j) {
      for (int i = at.i - radius; i <= at.i + radius; ++i) {
        box.push_back(samples[static_cast<std::size_t>(
            mirrored(i, n.i) + n.i * (mirrored(j, n.j) + n.j * mirrored(k, n.k)))]);
      }
    }
  }
  std::sort(box.begin(), box.end());
  return box[box.size() / 2];
}

// Samples between lo and hi, of which runs are equal.
template <class T>
std::vector<T> random_samples(Index3 n, double lo, double hi, std::uint64_t seed) {
  Random random(seed);
  std::vector<T> samples(static_cast<std::size_t>(n.i * n.j * n.k));
  T last{};
  for (T& s : samples) {
    if (random.below(4) != 0) last = static_cast<T>(random.uniform(lo, hi));
    s = last;
  }
  return samples;
}

template <class T>
void hold_against_oracle(Index3 n, double lo, double hi, std::uint64_t seed) {
  const std::vector<T> samples = random_samples<T>(n, lo, hi, seed);
  const Volume volume = Volume::from_samples(n, {1, 1, 1}, samples);
  for (int radius = 1; radius <= kLargestMedianRadius; ++radius) {
    CAPTURE(radius);
    CAPTURE(seed);
    const Volume one = median(volume, radius, 1), many = median(volume, radius, 3);
    REQUIRE(one.type() == volume.type());
    std::size_t wrong = 0, changed = 0;
    for_each_index(n, [&](int i, int j, int k) {
      const auto expected = static_cast<double>(oracle(samples, n, {i, j, k}, radius));
      wrong += one.sample(i, j, k) != expected || many.sample(i, j, k) != expected;
      changed += expected != volume.sample(i, j, k);
    });
    CHECK(wrong == 0);
    CHECK(changed > 0);
  }
}

}  // namespace

TEST_CASE("every sample is the median of its box, in all types over all their values") {
  const Index3 n{35, 13, 14};  // two tiles along each axis
  hold_against_oracle<std::uint8_t>(n, 0, 256, 1);
  hold_against_oracle<std::int8_t>(n, -128, 128, 2);
  hold_against_oracle<std::uint16_t>(n, 0, 65536, 3);
  hold_against_oracle<std::int16_t>(n, -32768, 32768, 4);
  hold_against_oracle<std::uint32_t>(n, 0, 4294967296.0, 5);
  hold_against_oracle<std::int32_t>(n, -2147483648.0, 2147483648.0, 6);
  hold_against_oracle<float>(n, -1e-3, 1e3, 7);
  hold_against_oracle<double>(n, -1e300, 1e300, 8);
}

TEST_CASE("the histogram finds medians far from the last one, and near the ends of the type") {
  hold_against_oracle<std::uint16_t>({20, 5, 5}, 65500, 65536, 9);
  hold_against_oracle<std::uint16_t>({20, 5, 5}, 0, 40, 10);
  // Stripes from end to end along x, so that every step crosses the whole type.
  std::vector<std::uint16_t> stripes;
  const Index3 n{40, 6, 6};
  for (int m = 0; m < n.i * n.j * n.k; ++m) {
    stripes.push_back(static_cast<std::uint16_t>(m % n.i / 4 % 2 == 0 ? m % 3 : 65535 - m % 5));
  }
  const Volume result = median(Volume::from_samples(n, {1, 1, 1}, stripes), 1);
  for (int i = 0; i < n.i; ++i) CHECK(result.sample(i, 3, 3) == oracle(stripes, n, {i, 3, 3}, 1));
}

TEST_CASE("a box thinner than the radius is reflected more than once") {
  hold_against_oracle<std::int16_t>({5, 2, 3}, -9, 9, 11);
  hold_against_oracle<float>({2, 2, 2}, -9, 9, 12);
}
