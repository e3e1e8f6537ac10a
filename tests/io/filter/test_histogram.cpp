// SPDX-License-Identifier: MIT
#include "io/filter/histogram.h"

#include <doctest/doctest.h>

#include <algorithm>
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

TEST_CASE("a single value and the widest range of samples do no harm") {
  const double largest = kLargestSample;
  for (const std::vector<double>& samples :
       {std::vector<double>{3, 3, 3}, {-largest, largest}, {0, largest}, {0, 5e-324}}) {
    const Histogram histogram = histogram_of(volume_of(samples));
    CHECK(std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::uint64_t{0}) ==
          samples.size());
    CHECK(!histogram_text(histogram, 16).empty());
  }
}
