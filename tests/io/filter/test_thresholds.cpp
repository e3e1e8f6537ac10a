// SPDX-License-Identifier: MIT
// Mixtures with known materials, and samples with and without padding.
#include "cases.h"
#include "io/filter/thresholds.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "base/random.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

template <class T>
Volume row_of(const std::vector<T>& samples) {
  return Volume::from_samples({static_cast<int>(samples.size()), 1, 1}, {1, 1, 1}, samples);
}

template <class T>
Thresholds thresholds_of(const std::vector<T>& samples) {
  const Volume volume = row_of(samples);
  return find_thresholds(volume, value_range(volume));
}

double normal(Random& random) {
  const double u = 1 - random.uniform();
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * random.uniform());
}

struct Normal {
  double mean, deviation, share;
};

// Two to five, at least seven deviations apart; one may be a hundredth of the largest.
std::vector<Normal> random_mixture(Random& random) {
  std::vector<Normal> parts;
  double at = -1000, total = 0;
  const std::size_t count = 2 + random.below(4);
  for (std::size_t n = 0; n < count; ++n) {
    const double deviation = random.uniform(8, 30);
    at += (n > 0 ? random.uniform(7, 20) : 0) *
          std::max(deviation, n > 0 ? parts[n - 1].deviation : 0);
    parts.push_back({at, deviation, std::exp(random.uniform(std::log(0.03), 0))});
    total += parts.back().share;
  }
  for (Normal& part : parts) part.share /= total;
  return parts;
}

template <class T>
std::vector<T> draw(Random& random, const std::vector<Normal>& parts, std::size_t count) {
  std::vector<T> samples;
  for (std::size_t n = 0; n < count; ++n) {
    double u = random.uniform();
    std::size_t k = 0;
    while (k + 1 < parts.size() && u >= parts[k].share) u -= parts[k++].share;
    const double x = parts[k].mean + parts[k].deviation * normal(random);
    samples.push_back(static_cast<T>(std::is_integral_v<T> ? std::round(x) : x));
  }
  return samples;
}

template <class T>
void check_mixture(std::uint64_t seed) {
  CAPTURE(seed);
  Random random(seed);
  const std::vector<Normal> parts = random_mixture(random);
  std::vector<T> samples = draw<T>(random, parts, 40000);
  const std::size_t padded = random.below(2) * (samples.size() / 4);
  samples.insert(samples.end(), padded, static_cast<T>(-3024));
  // Metal, far away.
  const std::size_t outliers = random.below(4);
  for (std::size_t n = 0; n < outliers; ++n) {
    samples.push_back(static_cast<T>(random.uniform(5000, 30000)));
  }
  const Thresholds found = thresholds_of(samples);
  REQUIRE(found.padding.size() == (padded > 0));
  if (padded > 0) {
    CHECK(found.padding[0].value == -3024);
    CHECK(found.padding[0].share == double(padded) / double(samples.size()));
  }
  // Three materials need two thresholds; of more some are not divided. None is cut in two,
  // but a small one between two large ones may be.
  CHECK(found.levels.size() >= (parts.size() == 2 ? 1u : 2u));
  CHECK(std::ranges::is_sorted(found.levels, {}, &Threshold::isovalue));
  for (const Threshold& level : found.levels) {
    CAPTURE(level.isovalue);
    double below = 0;
    for (const Normal& part : parts) {
      CAPTURE(part.share);
      if (part.share > 0.05) CHECK(std::abs(level.isovalue - part.mean) > part.deviation);
      if (part.mean < level.isovalue) below += part.share;
    }
    CHECK(level.below == doctest::Approx(below).epsilon(0.1));
    CHECK(level.mean_below < level.isovalue);
    CHECK(level.mean_above > level.isovalue);
    if (std::is_integral_v<T>) CHECK(level.isovalue != std::floor(level.isovalue));
  }
}

// Labels of a slice of a chest: air and padding around a body with lungs, fat and bones, with noise
// and with the mixed values that voxels at borders have.
std::vector<std::int16_t> synthetic_chest(double noise) {
  constexpr int kSide = 96;
  Random random(7);
  std::vector<std::int16_t> samples;
  const auto within = [](double x, double y, double cx, double cy, double rx, double ry) {
    const double d = 1 - std::hypot((x - cx) / rx, (y - cy) / ry);
    return std::clamp(d * std::min(rx, ry) + 0.5, 0.0, 1.0);
  };
  for_each_index({kSide, kSide, kSide}, [&](int i, int j, int k) {
    // Slices differ by parts of a voxel, lest the mixed values repeat.
    const double x = i - 47.5 + 0.02 * k, y = j - 47.5 + 0.03 * k;
    if (x * x + y * y > 47.5 * 47.5) {
      samples.push_back(-2000);
      return;
    }
    double value = -1000;
    const auto lay = [&](double what, double share) { value += share * (what - value); };
    lay(-100, within(x, y, 0, 0, 42, 33));
    lay(40, within(x, y, 0, 0, 37, 28));
    lay(-850, within(x, y, -16, -3, 13, 16));
    lay(-850, within(x, y, 16, -3, 13, 16));
    lay(random.uniform(300, 1500), within(x, y, 0, 17, 9, 9));
    samples.push_back(static_cast<std::int16_t>(std::round(value + noise * normal(random))));
  });
  return samples;
}

}  // namespace

TEST_CASE(
    "thresholds of mixtures of normal distributions are between them, with padding and outliers") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) check_mixture<std::int16_t>(seed);
  for (std::uint64_t seed = 201; seed <= 300; ++seed) check_mixture<float>(seed);
  for (std::uint64_t seed = 301; seed <= 400; ++seed) check_mixture<std::int32_t>(seed);
}

TEST_CASE("a material of few samples beyond the last mode has a threshold") {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    std::vector<std::int16_t> samples =
        draw<std::int16_t>(random, {{-1000, 30, 0.6}, {40, 20, 0.4}}, 40000);
    const std::size_t bone = 100 + random.below(2000);
    for (std::size_t n = 0; n < bone; ++n) {
      samples.push_back(static_cast<std::int16_t>(random.uniform(200, 1500)));
    }
    const Thresholds found = thresholds_of(samples);
    REQUIRE(found.levels.size() == 2);
    CHECK(found.levels[0].isovalue > -900);
    CHECK(found.levels[0].isovalue < -30);
    CHECK(found.levels[1].isovalue > 100);
    CHECK(found.levels[1].isovalue < 900);
  }
}

TEST_CASE("neither noise nor a comb splits one mode") {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Normal part{random.uniform(-500, 500), random.uniform(3, 200), 1};
    std::vector<std::int16_t> samples =
        draw<std::int16_t>(random, {part}, 500 + random.below(20000));
    const int factor = 1 + static_cast<int>(random.below(5));
    for (auto& s : samples) s = static_cast<std::int16_t>(s * factor);
    const Thresholds found = thresholds_of(samples);
    CHECK(found.padding.empty());
    REQUIRE(found.levels.size() == 1);
    CHECK(found.levels[0].below == doctest::Approx(0.5).epsilon(0.3));
  }
}

TEST_CASE("a chest: padding is named and has no threshold, skin and bone have one") {
  for (const double noise : {10.0, 20.0}) {
    CAPTURE(noise);
    const Thresholds found = thresholds_of(synthetic_chest(noise));
    REQUIRE(found.padding.size() == 1);
    CHECK(found.padding[0].value == -2000);
    CHECK(found.padding[0].share == doctest::Approx(0.23).epsilon(0.05));
    REQUIRE(found.levels.size() == 2);
    CHECK(found.levels[0].isovalue > -820);
    CHECK(found.levels[0].isovalue < -130);
    CHECK(found.levels[1].isovalue > 100);
    CHECK(found.levels[1].isovalue < 700);
  }
}

TEST_CASE("padding is found at either end and at both") {
  Random random(3);
  const std::vector<Normal> parts{{100, 10, 0.5}, {300, 20, 0.5}};
  const auto padded = [&](std::vector<double> values) {
    std::vector<double> samples = draw<double>(random, parts, 20000);
    for (const double v : values) samples.insert(samples.end(), 5000, v);
    return thresholds_of(samples);
  };
  const double largest = kLargestSample;
  for (const std::vector<double>& values : {std::vector<double>{},
                                            {-2000},
                                            {-32768},
                                            {65535},
                                            {1e20},
                                            {-2000, -1024},
                                            {-3024, 65535},
                                            {-1e20, 1e20},
                                            {-largest, largest}}) {
    CAPTURE(values);
    const Thresholds thresholds = padded(values);
    REQUIRE(thresholds.padding.size() == values.size());
    std::vector<double> found;
    for (const Padding& p : thresholds.padding) found.push_back(p.value);
    std::ranges::sort(found);
    std::vector<double> expected = values;
    std::ranges::sort(expected);
    CHECK(found == expected);
    REQUIRE(thresholds.levels.size() == 1);
    CHECK(thresholds.levels[0].isovalue > 130);
    CHECK(thresholds.levels[0].isovalue < 240);
    CHECK(thresholds.levels[0].below == doctest::Approx(0.5).epsilon(0.05));
  }
}

TEST_CASE("masks, labels, a background next to the rest and few samples are no padding") {
  const auto repeated = [](std::vector<std::uint8_t> values, std::size_t times) {
    std::vector<std::uint8_t> samples;
    for (const std::uint8_t v : values) samples.insert(samples.end(), times, v);
    return samples;
  };
  for (const auto& mask : {repeated({0, 1}, 500), repeated({0, 255}, 500)}) {
    const Thresholds found = thresholds_of(mask);
    CHECK(found.padding.empty());
    REQUIRE(found.levels.size() == 1);
    CHECK(found.levels[0].below == 0.5);
    CHECK(found.levels[0].isovalue > 0);
  }
  const Thresholds labels = thresholds_of(repeated({0, 50, 100, 200}, 500));
  CHECK(labels.padding.empty());
  CHECK(labels.levels.size() == 2);
  std::vector<std::uint8_t> ramp = repeated({0}, 100000);
  for (int v = 1; v < 256; ++v) ramp.insert(ramp.end(), 100, static_cast<std::uint8_t>(v));
  CHECK(thresholds_of(ramp).padding.empty());
  Random random(5);
  std::vector<std::int16_t> stray = draw<std::int16_t>(random, {{100, 10, 1}}, 20000);
  stray.insert(stray.end(), 50, -2000);
  CHECK(thresholds_of(stray).padding.empty());
}

TEST_CASE("single values and the widest range of samples do no harm") {
  const double largest = kLargestSample;
  CHECK(thresholds_of(std::vector<double>{3, 3, 3}).levels.empty());
  for (const std::vector<double>& samples :
       {std::vector<double>{-largest, largest}, {0, largest}, {0, 5e-324}, {1, 2, 3}, {1, 1e70}}) {
    const Thresholds found = thresholds_of(samples);
    for (const Threshold& v : found.levels) {
      CHECK(std::isfinite(v.isovalue));
      CHECK(v.isovalue > samples.front());
      CHECK(v.isovalue <= samples.back());
    }
  }
}

TEST_CASE("no two thresholds divide the bins better") {
  for (std::uint64_t seed = 1; seed <= test::cases(300u); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    // Three peaks, with gaps of 20 between them.
    std::vector<std::uint8_t> samples;
    std::vector<double> counts(140, 0);
    for (std::size_t n = 300 + random.below(500); n > 0; --n) {
      const std::uint32_t v = 60 * random.below(3) + random.below(20);
      samples.push_back(static_cast<std::uint8_t>(v));
      counts[v] += 1;
    }
    const Thresholds found = thresholds_of(samples);
    REQUIRE(found.levels.size() == 2);
    const auto within = [&](int first, int end) {
      double weight = 0, sum = 0, squares = 0;
      for (int v = std::max(first, 0); v < std::min(end, 140); ++v) {
        const double w = std::sqrt(counts[static_cast<std::size_t>(v)]);
        weight += w, sum += w * v, squares += w * v * v;
      }
      return weight > 0 ? squares - sum * sum / weight : 0;
    };
    const auto variance = [&](double low, double high) {
      const int a = static_cast<int>(std::ceil(low)), b = static_cast<int>(std::ceil(high));
      return within(0, a) + within(a, b) + within(b, 140);
    };
    double least = variance(found.levels[0].isovalue, found.levels[1].isovalue);
    const double best = least;
    for (int low = 0; low < 140; ++low) {
      for (int high = low; high <= 140; ++high) least = std::min(least, variance(low, high));
    }
    CHECK(best == doctest::Approx(least));
  }
}
