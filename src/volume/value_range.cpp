// SPDX-License-Identifier: MIT
// Passes over all samples, written so that compilers turn them into vector code: independent lanes
// in place of one running minimum, no branch inside a block.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>

#include "volume/volume.h"

namespace deliso {
namespace {

// Samples looked at between two checks for an early end.
constexpr std::size_t kBlock = 4096;

template <class T>
constexpr std::size_t kLanes = 64 / sizeof(T);

// Runs f(lane, sample) over all samples, f.block_done() behind every block; it may end the pass by
// returning true.
template <class T, class F, class Done>
void for_each_lane(const T* samples, std::size_t count, F f, Done block_done) {
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, count);
    std::size_t n = begin;
    for (; n + kLanes<T> <= end; n += kLanes<T>)
      for (std::size_t lane = 0; lane < kLanes<T>; ++lane) f(lane, samples[n + lane]);
    for (; n < end; ++n) f(0, samples[n]);
    if (block_done(begin, end)) return;
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

ValueRange value_range(const Volume& volume, std::string_view name) {
  const std::size_t count = volume.sample_count();
  return volume.visit([&](const auto* s) {
    using T = std::remove_cvref_t<decltype(*s)>;
    Extremes<T> extremes(s[0]);
    if constexpr (std::is_floating_point_v<T>) {
      // v * 0 is 0 for every finite v, else NaN, and NaN stays NaN in a sum.
      std::array<T, kLanes<T>> zeros{};
      for_each_lane(
          s, count,
          [&](std::size_t lane, T v) {
            extremes.add(lane, v);
            zeros[lane] += v * T{0};
          },
          [&](std::size_t begin, std::size_t) {
            T sum = 0;
            for (T zero : zeros) sum += zero;
            if (sum != 0) fail_sample(volume, name, s, begin);
            return false;
          });
    } else {
      for_each_lane(
          s, count, [&](std::size_t lane, T v) { extremes.add(lane, v); },
          [](std::size_t, std::size_t) { return false; });
    }
    return ValueRange{static_cast<double>(extremes.min()), static_cast<double>(extremes.max())};
  });
}

double effective_isovalue(const Volume& volume, double kappa) {
  const std::size_t count = volume.sample_count();
  return volume.visit([&](const auto* s) {
    using T = std::remove_cvref_t<decltype(*s)>;
    // Most isovalues are no value of the type, or no sample has it: then kappa stays.
    if (!(kappa >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
          kappa <= static_cast<double>(std::numeric_limits<T>::max())))
      return kappa;
    const T level = static_cast<T>(kappa);
    if (static_cast<double>(level) != kappa) return kappa;
    bool found = false;
    std::array<T, kLanes<T>> equal{};
    for_each_lane(
        s, count, [&](std::size_t lane, T v) { equal[lane] = v == level ? T{1} : equal[lane]; },
        [&](std::size_t, std::size_t) {
          return found = std::find(equal.begin(), equal.end(), T{1}) != equal.end();
        });
    return found ? lowered_isovalue(volume, kappa) : kappa;
  });
}

double lowered_isovalue(const Volume& volume, double kappa) {
  return volume.visit([&](const auto* s) {
    using T = std::remove_cvref_t<decltype(*s)>;
    // The greatest sample below kappa. Without one, all of the volume is inside.
    constexpr T lowest = std::numeric_limits<T>::lowest();
    Extremes<T> all(s[0]), below(lowest);
    for_each_lane(
        s, volume.sample_count(),
        [&](std::size_t lane, T v) {
          all.add(lane, v);
          below.add(lane, static_cast<double>(v) < kappa ? v : lowest);
        },
        [](std::size_t, std::size_t) { return false; });
    if (!(static_cast<double>(all.min()) < kappa)) return kappa;
    const double next = static_cast<double>(below.max());
    const double range = static_cast<double>(all.max()) - static_cast<double>(all.min());
    const double lowered =
        std::min(kappa - std::min(1e-9 * range, 0.5 * (kappa - next)), std::nextafter(kappa, next));
    return lowered > next ? lowered : kappa;
  });
}

}  // namespace deliso
