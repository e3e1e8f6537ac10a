// SPDX-License-Identifier: MIT
// Passes over all samples, written for vectorizing compilers: independent lanes instead of one
// running minimum, and no branch inside a run. Several threads process runs of samples; their
// results are combined in the order of the runs.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/parallel.h"
#include "volume/volume.h"

namespace deliso {
namespace {

// Number of samples in one task.
constexpr std::size_t kSamplesPerTask = std::size_t{1} << 21;

template <class T>
constexpr std::size_t kLanes = 64 / sizeof(T);

// Calls f(lane, sample) for the samples from `begin` to `end`.
template <class T, class F>
void for_each_lane(const T* samples, std::size_t begin, std::size_t end, F f) {
  for (; begin + kLanes<T> <= end; begin += kLanes<T>) {
    for (std::size_t lane = 0; lane < kLanes<T>; ++lane) f(lane, samples[begin + lane]);
  }
  for (; begin < end; ++begin) f(0, samples[begin]);
}

template <class T>
struct Extremes {
  std::array<T, kLanes<T>> lo, hi;

  explicit Extremes(T first) {
    lo.fill(first);
    hi.fill(first);
  }
  void add(std::size_t lane, T v) {
    lo[lane] = v < lo[lane] ? v : lo[lane];
    hi[lane] = hi[lane] < v ? v : hi[lane];
  }
  void add(const Extremes& other) {
    for (std::size_t lane = 0; lane < kLanes<T>; ++lane) {
      lo[lane] = std::min(lo[lane], other.lo[lane]);
      hi[lane] = std::max(hi[lane], other.hi[lane]);
    }
  }
  T min() const { return *std::min_element(lo.begin(), lo.end()); }
  T max() const { return *std::max_element(hi.begin(), hi.end()); }
};

template <class T>
[[noreturn]] void fail_sample(const Volume& volume, std::string_view name, const T* samples,
                              std::size_t n) {
  while (std::isfinite(samples[n])) ++n;
  const std::size_t nx = static_cast<std::size_t>(volume.dims().i);
  const std::size_t ny = static_cast<std::size_t>(volume.dims().j);
  throw InputError(std::string(name) + ": " + (std::isnan(samples[n]) ? "NaN" : "infinite") +
                   " sample at (" + std::to_string(n % nx) + ", " + std::to_string(n / nx % ny) +
                   ", " + std::to_string(n / nx / ny) + ")");
}

}  // namespace

ValueRange value_range(const Volume& volume, std::string_view name, int threads) {
  const std::size_t count = volume.sample_count();
  return volume.visit([&](const auto* s) {
    using T = std::remove_cvref_t<decltype(*s)>;
    std::vector<Extremes<T>> found(runs_of(count, kSamplesPerTask), Extremes<T>(s[0]));
    for_each_run(
        threads, count, kSamplesPerTask, [&](std::size_t run, std::size_t begin, std::size_t end) {
          Extremes<T> extremes(s[0]);
          if constexpr (std::is_floating_point_v<T>) {
            // v * 0 is 0 for every finite v and NaN otherwise, and a sum with a NaN is NaN.
            std::array<T, kLanes<T>> zeros{};
            for_each_lane(s, begin, end, [&](std::size_t lane, T v) {
              extremes.add(lane, v);
              zeros[lane] += v * T{0};
            });
            if (std::accumulate(zeros.begin(), zeros.end(), T{0}) != 0) {
              fail_sample(volume, name, s, begin);
            }
          } else {
            for_each_lane(s, begin, end, [&](std::size_t lane, T v) { extremes.add(lane, v); });
          }
          found[run] = extremes;
        });
    for (const Extremes<T>& extremes : found) found[0].add(extremes);
    return ValueRange{static_cast<double>(found[0].min()), static_cast<double>(found[0].max())};
  });
}

double isovalue_of_blocks(SampleType type, double kappa) {
  if (type == SampleType::f64) return kappa;
  if (type == SampleType::f32) {
    const auto level = static_cast<float>(kappa);
    if (static_cast<double>(level) != kappa) return kappa;
    const float next = std::nextafter(level, -std::numeric_limits<float>::infinity());
    return 0.5 * (kappa + static_cast<double>(next));
  }
  return kappa - std::min(0x1p-20, 0.5 * (kappa - (std::ceil(kappa) - 1)));
}

double effective_isovalue(const Volume& volume, double kappa, int threads) {
  if (volume.is_block()) return isovalue_of_blocks(volume.type(), kappa);
  const LoweredIsovalue lowered = lowered_isovalue(volume, kappa, threads);
  return lowered.is_sample ? lowered.kappa : kappa;
}

LoweredIsovalue lowered_isovalue(const Volume& volume, double kappa, int threads) {
  const std::size_t count = volume.sample_count();
  return volume.visit([&](const auto* s) {
    using T = std::remove_cvref_t<decltype(*s)>;
    constexpr T lowest = std::numeric_limits<T>::lowest(), highest = std::numeric_limits<T>::max();
    const std::optional<T> threshold = inside_threshold<T>(kappa);  // none: all are below
    struct Found {
      Extremes<T> all, below, inside;
    };
    const Found nothing{Extremes<T>(s[0]), Extremes<T>(lowest), Extremes<T>(highest)};
    std::vector<Found> found(runs_of(count, kSamplesPerTask), nothing);
    for_each_run(threads, count, kSamplesPerTask,
                 [&](std::size_t run, std::size_t begin, std::size_t end) {
                   Found here = nothing;
                   for_each_lane(s, begin, end,
                                 [&here, level = threshold.value_or(lowest), least = lowest,
                                  most = highest](std::size_t lane, T v) {
                                   here.all.add(lane, v);
                                   here.below.add(lane, v < level ? v : least);
                                   here.inside.add(lane, v < level ? most : v);
                                 });
                   found[run] = here;
                 });
    Found& whole = found[0];
    for (const Found& part : found) {
      whole.all.add(part.all);
      whole.below.add(part.below);
      whole.inside.add(part.inside);
    }
    const double min = static_cast<double>(whole.all.min());
    const double max = static_cast<double>(whole.all.max());
    // Without a sample below kappa, the whole volume is inside.
    if (!(min < kappa)) return LoweredIsovalue{kappa, min == kappa};
    const bool is_sample =
        threshold && max >= kappa && static_cast<double>(whole.inside.min()) == kappa;
    // The greatest sample below kappa.
    const double next = threshold ? static_cast<double>(whole.below.max()) : max;
    const double lowered = std::min(kappa - std::min(1e-9 * (max - min), 0.5 * (kappa - next)),
                                    std::nextafter(kappa, next));
    return LoweredIsovalue{lowered > next ? lowered : kappa, is_sample};
  });
}

}  // namespace deliso
