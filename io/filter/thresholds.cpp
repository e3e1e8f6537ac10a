// SPDX-License-Identifier: MIT
#include "io/filter/thresholds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "io/filter/histogram.h"

namespace deliso {
namespace {

constexpr int kThresholdBins = 256;
constexpr std::size_t kWindow = 7;     // bins at either side, for the height of the histogram
constexpr double kHighestRatio = 0.5;  // of the height at a threshold
constexpr double kPaddingShare = 0.01, kPaddingGap = 1.0 / 32;
// Up to this number of values they are labels, and none is padding.
constexpr int kMaxLabels = 32;

// The samples at the two ends of a range.
struct Ends {
  std::uint64_t at_min = 0, at_max = 0;
  ValueRange inner;  // of the samples strictly between; min > max if there are none
};

Ends ends_of(const Volume& volume, const ValueRange& range) {
  return volume.visit([&](const auto* samples) {
    Ends ends{0, 0, {range.max, range.min}};
    for (std::size_t n = 0; n < volume.sample_count(); ++n) {
      const auto v = static_cast<double>(samples[n]);
      ends.at_min += v == range.min;
      ends.at_max += v == range.max;
      if (v <= range.min || v >= range.max) continue;
      ends.inner = {std::min(ends.inner.min, v), std::max(ends.inner.max, v)};
    }
    return ends;
  });
}

// Removes the padding from the range and returns it.
std::vector<Padding> take_padding(const Volume& volume, ValueRange& range) {
  std::vector<Padding> low, high;
  ValueRange core = range;
  for (;;) {
    const auto [at_min, at_max, inner] = ends_of(volume, core);
    const auto all = static_cast<double>(volume.sample_count());
    const Padding least{core.min, static_cast<double>(at_min) / all};
    const Padding most{core.max, static_cast<double>(at_max) / all};
    if (std::max(least.share, most.share) < kPaddingShare) break;
    if (!(inner.min < inner.max)) return {};
    const Histogram h = bulk_histogram(volume, inner, kThresholdBins);
    const auto empty = std::ranges::count(h.counts, 0u);
    if (std::ssize(h.counts) - empty <= kMaxLabels) return {};
    const double wide = kPaddingGap * h.width * static_cast<double>(h.counts.size());
    const bool is_low = least.share >= kPaddingShare && inner.min - core.min > wide;
    const bool is_high = most.share >= kPaddingShare && core.max - inner.max > wide;
    if (!is_low && !is_high) break;
    if (is_low) low.push_back(least);
    if (is_high) high.push_back(most);
    core = {is_low ? inner.min : core.min, is_high ? inner.max : core.max};
  }
  range = core;
  low.insert(low.end(), high.rbegin(), high.rend());
  return low;
}

// Sums over bins, from those over all bins before each.
struct Sums {
  std::vector<double> weights{0}, moments{0};

  explicit Sums(const std::vector<double>& of_bins) {
    for (const double w : of_bins) {
      moments.push_back(moments.back() + w * (static_cast<double>(weights.size()) - 0.5));
      weights.push_back(weights.back() + w);
    }
  }
  double weight(std::size_t first, std::size_t end) const { return weights[end] - weights[first]; }
  double mean(std::size_t first, std::size_t end) const {  // in bins
    return (moments[end] - moments[first]) / weight(first, end);
  }
  // Its sum over classes grows with the variance between them.
  double spread(std::size_t first, std::size_t end) const {
    return weight(first, end) > 0 ? (moments[end] - moments[first]) * mean(first, end) : 0;
  }
};

// Returns the limits of three classes, or of two if the upper limit is at least the last bin.
std::array<std::size_t, 2> divide(const Sums& sums, std::size_t least_upper) {
  const std::size_t bins = sums.weights.size() - 1;
  std::array<std::size_t, 2> best{0, bins};
  double most = -1;
  for (std::size_t low = 1; low < bins; ++low) {
    for (std::size_t high = std::max(low + 1, least_upper); high <= bins; ++high) {
      const double spread = sums.spread(0, low) + sums.spread(low, high) + sums.spread(high, bins);
      if (spread > most) best = {low, high};
      most = std::max(most, spread);
    }
  }
  return best;
}

// Rounds an isovalue to about a bin's width. For an integer type it lies between two values, but
// not halfway: there the surface would pass through the middles of grid edges.
double isovalue_at(const Volume& volume, const ValueRange& range, double value, double width) {
  if (is_integer(volume.type())) return std::ceil(value) - 0.4;
  // A quotient of whole numbers is the double nearest to the decimal, a product is not.
  const double digits = std::floor(std::log10(width)), scale = std::pow(10, std::abs(digits));
  const double round =
      digits < 0 ? std::round(value * scale) / scale : std::round(value / scale) * scale;
  return range.min < round && round <= range.max ? round : value;
}

}  // namespace

Thresholds find_thresholds(const Volume& volume, const ValueRange& all) {
  Thresholds found;
  ValueRange range = all;
  found.padding = take_padding(volume, range);
  const Histogram h = bulk_histogram(volume, range, kThresholdBins);
  if (!(h.width > 0) || !std::isfinite(h.width)) return found;
  const std::vector<double> counts(h.counts.begin(), h.counts.end());
  std::vector<double> roots = counts;
  for (double& n : roots) n = std::sqrt(n);
  const Sums samples(counts), sums(roots);
  const std::size_t bins = counts.size();
  const auto height = [&](std::size_t bin) {
    const std::size_t first = bin - std::min(bin, kWindow), end = std::min(bin + kWindow + 1, bins);
    return samples.weight(first, end) / static_cast<double>(end - first);
  };
  // Of whole numbers the middle of a bin is lower.
  const double middle = is_integer(volume.type()) ? 0.5 : 0;
  const auto value_at = [&](double bin) { return h.range.min + h.width * bin; };
  const auto add_level = [&](std::size_t first, std::size_t limit, std::size_t end, double ratio) {
    if (samples.weight(first, limit) == 0 || samples.weight(limit, end) == 0) return;
    std::size_t low = limit, high = limit;  // of the gap around it
    while (counts[low - 1] == 0) --low;
    while (counts[high] == 0) ++high;
    double highest = 0;
    for (std::size_t b = first; b < end; ++b) highest = std::max(highest, height(b));
    if (height((low + high) / 2) > ratio * highest) return;
    const double value = value_at(static_cast<double>(low + high) / 2);
    found.levels.push_back({isovalue_at(volume, range, value, h.width),
                            samples.weight(0, limit) / samples.weight(0, bins),
                            value_at(samples.mean(first, limit)) - middle,
                            value_at(samples.mean(limit, end)) - middle});
  };
  const auto [low, high] = divide(sums, 0);
  add_level(0, low, high, kHighestRatio);
  add_level(low, high, bins, kHighestRatio);
  if (found.levels.empty()) add_level(0, divide(sums, bins)[0], bins, 1);
  return found;
}

}  // namespace deliso
