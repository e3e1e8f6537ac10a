// SPDX-License-Identifier: MIT
// Passes over all samples, written so that compilers turn them into vector code: independent lanes
// in place of one running minimum, no branch inside a block. Runs of samples go to several threads;
// what is found in each is put together in the order of the runs.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/parallel.h"
#include "volume/volume.h"

namespace deliso {
namespace {

// Samples looked at between two checks for an early end, and by one thread at a time.
constexpr std::size_t kBlock = 4096, kRun = std::size_t{1} << 21;

template <class T>
constexpr std::size_t kLanes = 64 / sizeof(T);

// Runs f(lane, sample) over the samples from `begin` to `end`, block_done(the block's first) behind
// every block; it may end the pass by returning true.
template <class T, class F, class Done>
void for_each_lane(const T* samples, std::size_t begin, std::size_t end, F f, Done block_done) {
  for (; begin < end; begin += kBlock) {
    const std::size_t block_end = std::min(begin + kBlock, end);
    std::size_t n = begin;
    for (; n + kLanes<T> <= block_end; n += kLanes<T>)
      for (std::size_t lane = 0; lane < kLanes<T>; ++lane) f(lane, samples[n + lane]);
    for (; n < block_end; ++n) f(0, samples[n]);
    if (block_done(begin)) return;
  }
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
    std::vector<Extremes<T>> found(runs_of(count, kRun), Extremes<T>(s[0]));
    for_each_run(threads, count, kRun, [&](std::size_t run, std::size_t begin, std::size_t end) {
      Extremes<T> extremes(s[0]);
      if constexpr (std::is_floating_point_v<T>) {
        // v * 0 is 0 for every finite v, else NaN, and NaN stays NaN in a sum.
        std::array<T, kLanes<T>> zeros{};
        for_each_lane(
            s, begin, end,
            [&](std::size_t lane, T v) {
              extremes.add(lane, v);
              zeros[lane] += v * T{0};
            },
            [&](std::size_t block) {
              T sum = 0;
              for (T zero : zeros) sum += zero;
              if (sum != 0) fail_sample(volume, name, s, block);
              return false;
            });
      } else {
        for_each_lane(
            s, begin, end, [&](std::size_t lane, T v) { extremes.add(lane, v); },
            [](std::size_t) { return false; });
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
  const std::size_t count = volume.sample_count();
  return volume.visit([&](const auto* s) {
    using T = std::remove_cvref_t<decltype(*s)>;
    // Most isovalues are no value of the type, or no sample has it: then kappa stays.
    if (!(kappa >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
          kappa <= static_cast<double>(std::numeric_limits<T>::max())))
      return kappa;
    const T level = static_cast<T>(kappa);
    if (static_cast<double>(level) != kappa) return kappa;
    std::atomic<bool> found = false;
    for_each_run(threads, count, kRun, [&](std::size_t begin, std::size_t end) {
      if (found) return;
      std::array<T, kLanes<T>> equal{};
      for_each_lane(
          s, begin, end,
          [&equal, level](std::size_t lane, T v) { equal[lane] = v == level ? T{1} : equal[lane]; },
          [&](std::size_t) {
            if (std::find(equal.begin(), equal.end(), T{1}) != equal.end()) found = true;
            return found.load();
          });
    });
    return found ? lowered_isovalue(volume, kappa, threads) : kappa;
  });
}

double lowered_isovalue(const Volume& volume, double kappa, int threads) {
  const std::size_t count = volume.sample_count();
  return volume.visit([&](const auto* s) {
    using T = std::remove_cvref_t<decltype(*s)>;
    // The greatest sample below kappa. Without one, all of the volume is inside.
    constexpr T lowest = std::numeric_limits<T>::lowest();
    const std::optional<T> threshold = inside_threshold<T>(kappa);  // none: all are below
    struct Found {
      Extremes<T> all, below;
    };
    std::vector<Found> found(runs_of(count, kRun), {Extremes<T>(s[0]), Extremes<T>(lowest)});
    for_each_run(threads, count, kRun, [&](std::size_t run, std::size_t begin, std::size_t end) {
      Found here = {Extremes<T>(s[0]), Extremes<T>(lowest)};
      for_each_lane(
          s, begin, end,
          [&here, level = threshold.value_or(lowest), none = lowest](std::size_t lane, T v) {
            here.all.add(lane, v);
            here.below.add(lane, v < level ? v : none);
          },
          [](std::size_t) { return false; });
      found[run] = here;
    });
    Found& whole = found[0];
    for (const Found& part : found) {
      whole.all.add(part.all);
      whole.below.add(part.below);
    }
    if (!(static_cast<double>(whole.all.min()) < kappa)) return kappa;
    const double next = static_cast<double>((threshold ? whole.below : whole.all).max());
    const double range =
        static_cast<double>(whole.all.max()) - static_cast<double>(whole.all.min());
    const double lowered =
        std::min(kappa - std::min(1e-9 * range, 0.5 * (kappa - next)), std::nextafter(kappa, next));
    return lowered > next ? lowered : kappa;
  });
}

}  // namespace deliso
