// SPDX-License-Identifier: MIT
#include "app/modes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "app/histogram.h"

namespace deliso {
namespace {

constexpr int kFineBins = 4096;
constexpr double kSpikeShare = 0.01, kGapShare = 1.0 / 32, kTailShare = 1e-3;  // M1
constexpr std::size_t kMaxSpikes = 3;                                          // at either end
// Up to this number of values they are labels: none is padding or noise around a mode.
constexpr std::size_t kMaxLabels = 16;
constexpr double kOutlierShare = 1e-4, kMinOccupiedBins = 2;              // M2
constexpr double kMinRatio = 1.5, kMinDeviations = 6, kAlikeSamples = 8;  // M3
constexpr int kKernels = 4;
constexpr std::size_t kTailHalfWidths = 2;  // M5
constexpr double kLeastTailShare = 1e-3;

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
      ends.inner.min = std::min(ends.inner.min, v);
      ends.inner.max = std::max(ends.inner.max, v);
    }
    return ends;
  });
}

std::uint64_t total_of(const Histogram& h) {
  return std::accumulate(h.counts.begin(), h.counts.end(), std::uint64_t{0});
}

// Returns the first and last bin without the tails, which have at most `share` of the samples each.
struct Span {
  std::size_t first, last;
};
Span span_of(const Histogram& h, double share) {
  const double allowed = share * static_cast<double>(total_of(h));
  Span span{0, h.counts.size() - 1};
  for (double sum = 0; span.first < span.last; ++span.first) {
    sum += static_cast<double>(h.counts[span.first]);
    if (sum > allowed) break;
  }
  for (double sum = 0; span.last > span.first; --span.last) {
    sum += static_cast<double>(h.counts[span.last]);
    if (sum > allowed) break;
  }
  return span;
}

// Returns a histogram without outliers. Outliers may be far away, so it makes new bins while most
// have only outliers.
Histogram fine_histogram(const Volume& volume, ValueRange range, double outliers) {
  for (;;) {
    Histogram h = make_histogram(volume, range, kFineBins);
    const Span span = span_of(h, outliers);
    const std::size_t kept = span.last - span.first + 1;
    if (2 * kept >= h.counts.size() || !(h.width > 0)) return h;
    const double low = range.min + h.width * static_cast<double>(span.first);
    const ValueRange inner{low, std::min(range.max, low + h.width * static_cast<double>(kept))};
    if (!(inner.max - inner.min < range.max - range.min)) return h;
    range = inner;
  }
}

// Returns the width above which a gap shows padding (M1); infinity if there are too few values.
double gap_beside(const Histogram& core) {
  const Span bulk = span_of(core, kTailShare);
  std::size_t widest = 0, empty = 0, occupied = 0;
  for (std::size_t b = bulk.first; b <= bulk.last; ++b) {
    empty = core.counts[b] > 0 ? 0 : empty + 1;
    widest = std::max(widest, empty + 1);
    occupied += core.counts[b] > 0;
  }
  if (occupied <= kMaxLabels) return std::numeric_limits<double>::infinity();
  const auto bins = static_cast<double>(bulk.last - bulk.first + 1);
  return core.width * std::max(kGapShare * bins, static_cast<double>(widest));
}

// Removes spikes that are not padding: the ones without a gap wider than `wide` inside them. The
// spikes of one end are ordered from outside in. Sets `end` to where the rest of the samples
// begins.
void keep_padding(std::vector<Padding>& spikes, double wide, double& end) {
  while (!spikes.empty() && !(std::abs(end - spikes.back().value) > wide)) {
    end = spikes.back().value;
    spikes.pop_back();
  }
}

// Removes the padding from the range and returns it.
std::vector<Padding> take_padding(const Volume& volume, ValueRange& range) {
  std::vector<Padding> low, high;
  const auto all = static_cast<double>(volume.sample_count());
  ValueRange core = range;
  for (std::size_t n = 0; n < kMaxSpikes; ++n) {
    const Ends ends = ends_of(volume, core);
    const double at_min = static_cast<double>(ends.at_min) / all;
    const double at_max = static_cast<double>(ends.at_max) / all;
    if (std::max(at_min, at_max) < kSpikeShare) break;
    if (!(ends.inner.min < ends.inner.max)) return {};
    if (at_min >= kSpikeShare) {
      low.push_back({core.min, at_min});
      core.min = ends.inner.min;
    }
    if (at_max >= kSpikeShare) {
      high.push_back({core.max, at_max});
      core.max = ends.inner.max;
    }
  }
  if (low.empty() && high.empty()) return {};
  const double wide = gap_beside(fine_histogram(volume, core, kTailShare));
  keep_padding(low, wide, core.min);
  keep_padding(high, wide, core.max);
  range = core;
  low.insert(low.end(), high.rbegin(), high.rend());
  return low;
}

// Returns the length of the shortest interval with an eighth of the samples, in bins.
double shortest_eighth(const Histogram& h) {
  const auto eighth = (total_of(h) + 7) / 8;
  std::size_t best = h.counts.size(), end = 0;
  std::uint64_t inside = 0;
  for (std::size_t begin = 0; begin < h.counts.size(); ++begin) {
    while (end < h.counts.size() && inside < eighth) inside += h.counts[end++];
    if (inside < eighth) break;
    best = std::min(best, end - begin);
    inside -= h.counts[begin];
  }
  return static_cast<double>(best);
}

// Returns the standard deviation of the kernel, in bins.
double kernel_of(const Histogram& h) {
  const Span span = span_of(h, kOutlierShare);
  const auto occupied = static_cast<std::size_t>(std::count_if(
      h.counts.begin() + static_cast<std::ptrdiff_t>(span.first),
      h.counts.begin() + static_cast<std::ptrdiff_t>(span.last) + 1, [](auto n) { return n > 0; }));
  if (occupied <= kMaxLabels) return 0.5;
  const double step =
      static_cast<double>(span.last - span.first + 1) / static_cast<double>(occupied);
  constexpr double kEighth = 0.3147;  // its length for a normal distribution of deviation 1
  const double best =
      0.9 * shortest_eighth(h) / kEighth * std::pow(static_cast<double>(total_of(h)), -0.2);
  return std::max(best, kMinOccupiedBins * step);
}

std::vector<double> smoothed(const Histogram& h, double sigma) {
  const auto reach = static_cast<std::size_t>(std::ceil(4 * sigma));
  std::vector<double> kernel(reach + 1), density(h.counts.size(), 0);
  double sum = 0;
  for (std::size_t n = 0; n <= reach; ++n) {
    const double x = static_cast<double>(n) / sigma;
    kernel[n] = std::exp(-0.5 * x * x);
    sum += (n > 0 ? 2 : 1) * kernel[n];
  }
  for (std::size_t b = 0; b < h.counts.size(); ++b) {
    if (h.counts[b] == 0) continue;
    const double here = static_cast<double>(h.counts[b]) / sum;
    for (std::size_t n = b - std::min(b, reach); n <= std::min(b + reach, density.size() - 1);
         ++n) {
      density[n] += here * kernel[n < b ? b - n : n - b];
    }
  }
  return density;
}

// Returns a height for M3, such that a valley of depth 1 counts. With few samples under the kernel
// the height grows by their standard deviations: 2 sqrt(n) has a deviation of 1. With many it grows
// by their ratio.
double height(double samples) {
  const double per_ratio = 1 / std::log(kMinRatio);
  const double turn = std::pow(kMinDeviations * per_ratio, 2);
  if (samples <= turn) return 2 * std::sqrt(samples) / kMinDeviations;
  return 2 * std::sqrt(turn) / kMinDeviations + per_ratio * std::log(samples / turn);
}

// An extreme of the heights. In a list, modes are at even places, the valleys between at odd ones.
struct Extreme {
  std::size_t bin;
  double height;
};

std::vector<Extreme> extremes_of(const std::vector<double>& heights) {
  std::vector<Extreme> out;
  bool rising = true;
  for (std::size_t b = 0; b < heights.size();) {
    std::size_t end = b + 1;
    while (end < heights.size() && heights[end] == heights[b]) ++end;
    const double next = end < heights.size() ? heights[end] : (rising ? -1 : heights[b]);
    if (next != heights[b] && rising != (next > heights[b])) {
      out.push_back({(b + end - 1) / 2, heights[b]});
      rising = !rising;
    }
    b = end;
  }
  if (out.size() % 2 == 0 && !out.empty()) out.pop_back();  // a valley at the end
  return out;
}

double depth_of(const std::vector<Extreme>& extremes, std::size_t valley) {
  return std::min(extremes[valley - 1].height, extremes[valley + 1].height) -
         extremes[valley].height;
}

// Removes the shallowest valley while its depth is below 1, with the lower mode beside it.
void drop_bumps(std::vector<Extreme>& extremes) {
  while (extremes.size() >= 3) {
    std::size_t shallowest = 1;
    for (std::size_t n = 3; n < extremes.size(); n += 2) {
      if (depth_of(extremes, n) < depth_of(extremes, shallowest)) shallowest = n;
    }
    if (depth_of(extremes, shallowest) >= 1) return;
    const bool left_is_lower = extremes[shallowest - 1].height < extremes[shallowest + 1].height;
    const auto at =
        extremes.begin() + static_cast<std::ptrdiff_t>(left_is_lower ? shallowest - 1 : shallowest);
    extremes.erase(at, at + 2);
  }
}

// The floor of a valley, in bins.
struct ValleyFloor {
  double middle;
  std::size_t lowest;
  double depth;
};

ValleyFloor floor_of(const std::vector<double>& heights, const std::vector<Extreme>& extremes,
                     std::size_t valley) {
  std::size_t first = extremes[valley].bin, last = first;
  const double rim = extremes[valley].height + 1;
  while (first > 0 && heights[first - 1] < rim) --first;
  while (last + 1 < heights.size() && heights[last + 1] < rim) ++last;
  return {static_cast<double>(first + last) / 2, extremes[valley].bin, depth_of(extremes, valley)};
}

// Adds the valleys of one kernel, if no known valley lies between the same modes.
void add_floors(const Histogram& h, double sigma, std::vector<ValleyFloor>& floors) {
  // A kernel estimate has the deviation of this number of samples.
  const double counted = 2 * std::sqrt(std::numbers::pi) * sigma / kAlikeSamples;
  std::vector<double> heights = smoothed(h, sigma);
  for (double& d : heights) d = height(d * counted);
  std::vector<Extreme> extremes = extremes_of(heights);
  drop_bumps(extremes);
  const std::size_t before = floors.size();
  for (std::size_t n = 1; n + 1 < extremes.size(); n += 2) {
    const auto is_between = [&](const ValleyFloor& floor) {
      return extremes[n - 1].bin < floor.lowest && floor.lowest < extremes[n + 1].bin;
    };
    const auto known = floors.begin() + static_cast<std::ptrdiff_t>(before);
    if (std::any_of(floors.begin(), known, is_between)) continue;
    floors.push_back(floor_of(heights, extremes, n));
  }
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

void count_sides(const Volume& volume, const ValueRange& range, std::vector<Valley>& valleys) {
  std::vector<std::uint64_t> below(valleys.size(), 0);
  std::uint64_t all = 0;
  volume.visit([&](const auto* samples) {
    for (std::size_t n = 0; n < volume.sample_count(); ++n) {
      const auto v = static_cast<double>(samples[n]);
      if (v < range.min || v > range.max) continue;
      ++all;
      for (std::size_t k = 0; k < valleys.size(); ++k) below[k] += v < valleys[k].isovalue;
    }
  });
  for (std::size_t k = 0; k < valleys.size(); ++k) {
    valleys[k].below = static_cast<double>(below[k]) / static_cast<double>(all);
    valleys[k].above = static_cast<double>(all - below[k]) / static_cast<double>(all);
  }
}

}  // namespace

Modes find_modes(const Volume& volume, const ValueRange& all, std::size_t most) {
  Modes modes;
  ValueRange range = all;
  modes.padding = take_padding(volume, range);
  if (!(range.min < range.max)) return modes;
  const Histogram h = fine_histogram(volume, range, kOutlierShare);
  if (!(h.width > 0) || !std::isfinite(h.width)) return modes;
  const double sigma = kernel_of(h);
  std::vector<ValleyFloor> floors;
  for (int n = 0; n < kKernels; ++n) add_floors(h, std::ldexp(sigma, n), floors);
  std::ranges::sort(floors, {}, &ValleyFloor::lowest);

  // The middle of a bin or, for an integer type, of its values.
  const double middle = is_integer(volume.type()) ? 0.5 * (h.width - 1) : 0.5 * h.width;
  const auto value_at = [&](double bin) { return h.range.min + middle + h.width * bin; };
  const std::vector<double> density = smoothed(h, sigma);
  const auto mode_between = [&](std::size_t begin, std::size_t end) {
    const auto first = density.begin();
    return std::max_element(first + static_cast<std::ptrdiff_t>(begin),
                            first + static_cast<std::ptrdiff_t>(end)) -
           first;
  };
  for (std::size_t n = 0; n < floors.size(); ++n) {
    const auto below = mode_between(n > 0 ? floors[n - 1].lowest : 0, floors[n].lowest + 1);
    const auto above = mode_between(
        floors[n].lowest, n + 1 < floors.size() ? floors[n + 1].lowest + 1 : density.size());
    Valley& v = modes.valleys.emplace_back();
    v.isovalue = isovalue_at(volume, range, value_at(floors[n].middle), h.width);
    v.mode_below = value_at(static_cast<double>(below));
    v.mode_above = value_at(static_cast<double>(above));
    v.score = floors[n].depth;
  }
  modes.by_otsu = modes.valleys.empty();
  if (modes.by_otsu) {
    modes.valleys.emplace_back().isovalue = isovalue_at(volume, range, otsu_threshold(h), h.width);
  } else {
    const std::size_t lowest = floors.back().lowest;
    const auto mode = static_cast<std::size_t>(mode_between(lowest, density.size()));
    std::size_t half = mode;
    while (half < density.size() && 2 * density[half] > density[mode]) ++half;
    Histogram above = h;
    std::fill_n(above.counts.begin(), lowest, 0);
    const double threshold = otsu_threshold(above);
    if (threshold > value_at(static_cast<double>(mode + kTailHalfWidths * (half - mode)))) {
      Valley& tail = modes.valleys.emplace_back();
      tail.isovalue = isovalue_at(volume, range, threshold, h.width);
      tail.mode_below = value_at(static_cast<double>(mode));
      tail.in_tail = true;
    }
  }
  count_sides(volume, range, modes.valleys);
  std::erase_if(modes.valleys,
                [](const Valley& v) { return v.in_tail && v.above < kLeastTailShare; });
  for (Valley& v : modes.valleys) v.score *= std::min(v.below, v.above);
  std::ranges::stable_sort(modes.valleys, std::greater<>(), &Valley::score);
  if (modes.valleys.size() > most) modes.valleys.resize(most);
  return modes;
}

}  // namespace deliso
