// SPDX-License-Identifier: MIT
#include "io/filter/segmentation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <type_traits>
#include <utility>

#include "base/check.h"
#include "base/parallel.h"
#include "base/text.h"
#include "io/files/input_file.h"

namespace deliso {
namespace {

constexpr std::size_t kSlicesOfCount = 8;
constexpr double kLargestLabel = 0x1p53;  // beyond it doubles skip whole numbers
constexpr std::size_t kLabelsNamed = 12;  // in a message

using Found = std::map<std::int64_t, LabelSamples>;

void add(LabelSamples& to, const LabelSamples& from) {
  if (to.samples == 0) {
    const std::int64_t label = to.label;
    to = from;
    to.label = label;
    return;
  }
  to.samples += from.samples;
  to.volume += from.volume;
  for (int axis = 0; axis < 3; ++axis) {
    to.first[axis] = std::min(to.first[axis], from.first[axis]);
    to.last[axis] = std::max(to.last[axis], from.last[axis]);
  }
}

template <class T>
std::int64_t label_of(T value, Index3 at, std::string_view name) {
  if constexpr (std::is_floating_point_v<T>) {
    if (!(std::fabs(value) <= kLargestLabel) || std::floor(value) != value) {
      fail(name, text("the sample at (", at.i, ", ", at.j, ", ", at.k, ") is ",
                      static_cast<double>(value), ", and labels are whole numbers"));
    }
  }
  return static_cast<std::int64_t>(value);
}

// The share of a voxel that sample i of n stands for along an axis.
double share_at(int i, int n) {
  return i == 0 || i == n - 1 ? 0.5 : 1;
}

// Adds the labels of a row, one run of equal samples after the other.
template <class T>
void add_row(Found& found, const T* row, Index3 dims, int j, int k, std::string_view name) {
  const double share = share_at(j, dims.j) * share_at(k, dims.k);
  for (int begin = 0; begin < dims.i;) {
    int end = begin + 1;
    while (end < dims.i && row[end] == row[begin]) ++end;
    const double ends = (begin == 0 ? 0.5 : 0) + (end == dims.i ? 0.5 : 0);
    LabelSamples run{label_of(row[begin], {begin, j, k}, name),
                     static_cast<std::uint64_t>(end - begin),
                     share * (end - begin - ends),
                     {begin, j, k},
                     {end - 1, j, k}};
    LabelSamples& all = found[run.label];
    all.label = run.label;
    add(all, run);
    begin = end;
  }
}

// Calls f with the values at points of the voxel. They are a lattice of 64 points that has 64
// values along each axis (Korobov 1959): surfaces of labels are often in planes of the grid, where
// 4 x 4 x 4 points have 4.
constexpr int kPointsOfVoxel = 64;
template <class F>
void for_points(const Corners& c, F&& f) {
  const auto mix = [](double a, double b, double t) { return a + t * (b - a); };
  for (int n = 0; n < kPointsOfVoxel; ++n) {
    const auto at = [n](int step) { return (n * step % kPointsOfVoxel + 0.5) / kPointsOfVoxel; };
    const double x = at(1), y = at(19), z = at(27);
    f(mix(mix(mix(c[0], c[1], x), mix(c[2], c[3], x), y),
          mix(mix(c[4], c[5], x), mix(c[6], c[7], x), y), z));
  }
}

// Counts of points in bins of equal width from 0 to the greatest sample.
constexpr std::size_t kBins = 4096;
struct Counts {
  std::vector<std::uint64_t> of_bin = std::vector<std::uint64_t>(kBins);
  std::uint64_t at_half = 0;  // points of at least one half
};

void count_points(const Volume& volume, double greatest, int k, Counts& counts) {
  const double scale = kBins / greatest;
  const auto bin_of = [&](double value) {
    return std::min(static_cast<std::size_t>(std::max(0.0, value * scale)), kBins - 1);
  };
  const Index3 voxels = volume.voxels();
  for (int j = 0; j < voxels.j; ++j) {
    for (int i = 0; i < voxels.i; ++i) {
      const Corners c = volume.corners({i, j, k});
      if (std::all_of(c.begin(), c.end(), [&](double v) { return v == c[0]; })) {
        counts.of_bin[bin_of(c[0])] += kPointsOfVoxel;
        if (c[0] >= 0.5) counts.at_half += kPointsOfVoxel;
        continue;
      }
      for_points(c, [&](double value) {
        ++counts.of_bin[bin_of(value)];
        counts.at_half += value >= 0.5;
      });
    }
  }
}

}  // namespace

std::vector<LabelSamples> find_labels(const Volume& volume, std::string_view name, int threads) {
  const Index3 dims = volume.dims();
  const auto slices = static_cast<std::size_t>(dims.k);
  std::vector<Found> found(runs_of(slices, kSlicesOfCount));
  volume.visit([&](const auto* samples) {
    for_each_run(threads, slices, kSlicesOfCount,
                 [&](std::size_t task, std::size_t begin, std::size_t end) {
                   for (int k = static_cast<int>(begin); k < static_cast<int>(end); ++k) {
                     for (int j = 0; j < dims.j; ++j) {
                       add_row(found[task], samples + volume.index(0, j, k), dims, j, k, name);
                     }
                   }
                 });
  });
  Found all;
  for (const Found& part : found) {
    for (const auto& [label, samples] : part) {
      all[label].label = label;
      add(all[label], samples);
    }
  }
  std::vector<LabelSamples> labels;
  for (const auto& [label, samples] : all) labels.push_back(samples);
  return labels;
}

LabelSamples united_labels(std::span<const LabelSamples> found,
                           std::span<const std::int64_t> labels, std::string_view name) {
  LabelSamples all;
  all.label = labels.front();
  for (const std::int64_t label : labels) {
    const auto at = std::ranges::find(found, label, &LabelSamples::label);
    if (at == found.end()) {
      std::string there;
      for (std::size_t n = 0; n < std::min(found.size(), kLabelsNamed); ++n) {
        there += text(n == 0 ? "" : ", ", found[n].label);
      }
      fail(name, text("no sample has label ", label, ": its ", found.size(), " labels are ", there,
                      found.size() > kLabelsNamed ? ", ..." : ""));
    }
    add(all, *at);
  }
  return all;
}

Volume label_indicator(const Volume& volume, std::span<const std::int64_t> labels,
                       const LabelSamples& extent, Index3 margin, int threads) {
  DELISO_CHECK(!volume.is_block());
  const Index3 whole = volume.dims();
  Index3 first, dims;
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = std::max(0, extent.first[axis] - margin[axis]);
    dims[axis] = std::min(whole[axis] - 1, extent.last[axis] + margin[axis]) + 1 - first[axis];
  }
  const std::size_t nx = static_cast<std::size_t>(dims.i), ny = static_cast<std::size_t>(dims.j);
  Buffer buffer(nx * ny * static_cast<std::size_t>(dims.k));
  auto* const out = reinterpret_cast<std::uint8_t*>(buffer.data.get());
  const auto is_in = [&](auto value) {
    return std::find(labels.begin(), labels.end(), static_cast<std::int64_t>(value)) !=
           labels.end();
  };
  volume.visit([&](const auto* samples) {
    for_each_task(threads, static_cast<std::size_t>(dims.k), [&](std::size_t k) {
      for (std::size_t j = 0; j < ny; ++j) {
        const auto* row = samples + volume.index(first.i, first.j + static_cast<int>(j),
                                                 first.k + static_cast<int>(k));
        for (std::size_t i = 0; i < nx; ++i) out[(k * ny + j) * nx + i] = is_in(row[i]);
      }
    });
  });
  Frame frame = volume.frame();
  frame.origin = frame.to_world(volume.position(first));
  const Bytes bytes = bytes_of(std::move(buffer), {});
  return {dims, volume.spacing(), SampleType::u8, bytes.data.data(), bytes.owner, frame};
}

IndicatorLevel find_level(const Volume& indicator, double target, int threads) {
  const double greatest = value_range(indicator, "indicator").max;
  if (!(greatest > 0)) return {0, 0.5};
  const auto slices = static_cast<std::size_t>(std::max(0, indicator.voxels().k));
  std::vector<Counts> parts(runs_of(slices, kSlicesOfCount));
  for_each_run(threads, slices, kSlicesOfCount,
               [&](std::size_t task, std::size_t begin, std::size_t end) {
                 for (std::size_t k = begin; k < end; ++k) {
                   count_points(indicator, greatest, static_cast<int>(k), parts[task]);
                 }
               });
  Counts all;
  for (const Counts& part : parts) {
    all.at_half += part.at_half;
    for (std::size_t n = 0; n < kBins; ++n) all.of_bin[n] += part.of_bin[n];
  }
  IndicatorLevel result{static_cast<double>(all.at_half) / kPointsOfVoxel, 0};
  // From above, bin by bin, with points spread evenly over the last one.
  const double wanted = target * kPointsOfVoxel;
  double above = 0;
  for (std::size_t n = kBins; n-- > 0;) {
    const auto here = static_cast<double>(all.of_bin[n]);
    if (above + here < wanted && n > 0) {
      above += here;
      continue;
    }
    const double share = here > 0 ? (wanted - above) / here : 0;
    result.level = (static_cast<double>(n) + 1 - share) * greatest / kBins;
    break;
  }
  return result;
}

}  // namespace deliso
