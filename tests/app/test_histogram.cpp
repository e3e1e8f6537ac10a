// SPDX-License-Identifier: MIT
#include "app/histogram.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/random.h"

using namespace deliso;

namespace {

template <class T>
Volume volume_of(const std::vector<T>& samples) {
  return Volume::from_samples({static_cast<int>(samples.size()), 1, 1}, {1, 1, 1}, samples);
}

Histogram histogram_of(const Volume& volume) {
  return make_histogram(volume, value_range(volume), 256);
}

// Between-class variance of {< threshold} and {>= threshold}, straight from the samples.
template <class T>
double variance_between(const std::vector<T>& samples, double threshold) {
  double counts[2] = {0, 0}, sums[2] = {0, 0};
  for (const T s : samples) {
    const int side = s >= threshold;
    ++counts[side];
    sums[side] += static_cast<double>(s);
  }
  if (counts[0] == 0 || counts[1] == 0) return 0;
  const double gap = sums[0] / counts[0] - sums[1] / counts[1];
  return counts[0] * counts[1] * gap * gap;
}

}  // namespace

TEST_CASE("every sample is in one bin, its own where there is a bin per value") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    std::vector<std::int16_t> samples(1 + random.below(500));
    const int lo = static_cast<int>(random.below(1000)) - 500;
    const std::uint32_t span = 1 + random.below(300);
    for (auto& s : samples)
      s = static_cast<std::int16_t>(lo + static_cast<int>(random.below(span)));
    const Histogram histogram = histogram_of(volume_of(samples));
    const auto& counts = histogram.counts;
    CHECK(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}) == samples.size());
    if (histogram.width != 1) continue;
    for (std::size_t b = 0; b < counts.size(); ++b) {
      const double value = histogram.range.min + static_cast<double>(b);
      CHECK(counts[b] ==
            static_cast<std::uint64_t>(std::count(samples.begin(), samples.end(), value)));
    }
  }
}

TEST_CASE("no threshold separates the samples better than Otsu's") {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    std::vector<std::uint8_t> samples(20 + random.below(500));
    const std::uint32_t peaks[] = {random.below(200), random.below(200)};
    for (auto& s : samples)
      s = static_cast<std::uint8_t>(peaks[random.below(2)] + random.below(40));
    const Volume volume = volume_of(samples);
    const double isovalue = std::ceil(otsu_threshold(histogram_of(volume))) - 0.4;
    double best = 0;
    for (int threshold = 0; threshold <= 256; ++threshold) {
      best = std::max(best, variance_between(samples, threshold));
    }
    CHECK(variance_between(samples, isovalue) == doctest::Approx(best));
  }
}

TEST_CASE("a single value and the widest range of doubles do no harm") {
  const double largest = std::numeric_limits<double>::max();
  for (const std::vector<double>& samples :
       {std::vector<double>{3, 3, 3}, {-largest, largest}, {0, largest}, {0, 5e-324}}) {
    const Histogram histogram = histogram_of(volume_of(samples));
    CHECK(std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::uint64_t{0}) ==
          samples.size());
    otsu_threshold(histogram);
    CHECK(!histogram_text(histogram, 16).empty());
  }
}
