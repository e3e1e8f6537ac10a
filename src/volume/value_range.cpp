// SPDX-License-Identifier: MIT
// A pass over all samples, written for vectorizing compilers: independent lanes instead of one
// running minimum, and no branch inside a run.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string>
#include <type_traits>

#include "base/check.h"
#include "base/text.h"
#include "volume/volume.h"

namespace deliso {
namespace {

template <class T>
constexpr std::size_t kLanes = 64 / sizeof(T);

// Calls f(lane, sample) for each of the samples.
template <class T, class F>
void for_each_lane(const T* samples, std::size_t count, F f) {
  std::size_t n = 0;
  for (; n + kLanes<T> <= count; n += kLanes<T>) {
    for (std::size_t lane = 0; lane < kLanes<T>; ++lane) f(lane, samples[n + lane]);
  }
  for (; n < count; ++n) f(0, samples[n]);
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
bool is_in_range(T sample) {
  return std::fabs(static_cast<double>(sample)) <= kLargestSample;
}

template <class T>
[[noreturn]] void fail_sample(const Volume& volume, std::string_view name, const T* samples) {
  std::size_t n = 0;
  while (is_in_range(samples[n])) ++n;
  const std::size_t nx = static_cast<std::size_t>(volume.dims().i);
  const std::size_t ny = static_cast<std::size_t>(volume.dims().j);
  const auto place = [](std::size_t index, int first) {
    return std::to_string(index + static_cast<std::size_t>(first));
  };
  const Index3 first = volume.first();
  const std::string at = text(" sample at (", place(n % nx, first.i), ", ",
                              place(n / nx % ny, first.j), ", ", place(n / nx / ny, first.k), ")");
  if (std::isnan(samples[n])) {
    throw InputError(name, ": NaN", at, ": --nan VALUE gives such samples a value");
  }
  if (std::isinf(samples[n])) throw InputError(name, ": infinite", at);
  throw InputError(name, ": the", at, " is ", samples[n], ", out of range (", -kLargestSample,
                   " to ", kLargestSample, "): scale all samples, or replace a fill value");
}

// How far below an isovalue that samples may equal the level lies, in steps of integers: the golden
// section, 1/phi^2. The surface keeps off samples on both sides, and of all numbers this one is the
// furthest from fractions (Hurwitz), which saddles are. Tried on ten volumes, docs/decisions.md.
constexpr double kBelowSample = 0.38196601125;
// The same for an isovalue that saddles alone may equal: there the surface is off all samples.
constexpr double kBelowSaddle = 0x1p-20;

}  // namespace

ValueRange value_range(const Volume& volume, std::string_view name) {
  return volume.visit([&](const auto* s) {
    using T = std::remove_cvref_t<decltype(*s)>;
    Extremes<T> extremes(s[0]);
    if constexpr (std::is_floating_point_v<T>) {
      // v * 0 is 0 for every finite v and NaN otherwise, and a sum with a NaN is NaN.
      std::array<T, kLanes<T>> zeros{};
      for_each_lane(s, volume.sample_count(), [&](std::size_t lane, T v) {
        extremes.add(lane, v);
        zeros[lane] += v * T{0};
      });
      const bool is_finite = std::accumulate(zeros.begin(), zeros.end(), T{0}) == 0;
      if (!is_finite || !is_in_range(extremes.min()) || !is_in_range(extremes.max())) {
        fail_sample(volume, name, s);
      }
    } else {
      for_each_lane(s, volume.sample_count(),
                    [&](std::size_t lane, T v) { extremes.add(lane, v); });
    }
    return ValueRange{static_cast<double>(extremes.min()), static_cast<double>(extremes.max())};
  });
}

double geometric_isovalue(SampleType type, double isovalue) {
  if (type == SampleType::f64) return isovalue;
  if (type == SampleType::f32) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    if (!(-kLargest < isovalue && isovalue <= kLargest)) return isovalue;
    const auto level = static_cast<float>(isovalue);
    if (static_cast<double>(level) != isovalue) return isovalue;
    const float next = std::nextafter(level, -std::numeric_limits<float>::infinity());
    return 0.5 * (isovalue + static_cast<double>(next));
  }
  const double in_steps = std::ldexp(isovalue, 8 * static_cast<int>(size_of(type)));
  if (in_steps != std::floor(in_steps)) return isovalue;
  const double below = std::ceil(isovalue) - 1;
  const bool is_sample = isovalue == std::floor(isovalue);
  const double lowered =
      isovalue - (is_sample ? kBelowSample : std::min(kBelowSaddle, 0.5 * (isovalue - below)));
  return lowered > below ? lowered : isovalue;  // they might be adjacent
}

}  // namespace deliso
