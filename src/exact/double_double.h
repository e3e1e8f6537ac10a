// SPDX-License-Identifier: MIT
// Numbers of about 106 bits as unevaluated sums of two doubles (Dekker 1971).
//
// The product has a relative error below 7 * 2^-106 (Joldes, Muller and Popescu 2017, "Tight and
// rigorous error bounds for basic building blocks of double-word arithmetic", algorithm 10).
//
// The sum is Dekker's, with an error below 4 * 2^-106 of |a| + |b|. It has three roundings, each
// below 2^-52 (|a| + |b|). A bound from a permanent needs no more, and a sum accurate under
// cancellation costs twice the work.
//
// About fifteen times as slow as doubles, a tenth of the time of expansions.
#pragma once

#include "base/vec3.h"
#include "exact/expansion.h"

namespace deliso {

// Bounds the error of * below relative to the product, and of + and - relative to |a| + |b|.
inline constexpr double kDoubleDoubleEpsilon = 0x1p-103;

struct DoubleDouble {
  double high = 0, low = 0;

  static DoubleDouble difference(double a, double b) {
    const TwoTerms d = two_sum(a, -b);
    return {d.value, d.error};
  }
  double rounded() const { return high + low; }

  friend DoubleDouble operator-(DoubleDouble a) { return {-a.high, -a.low}; }
  friend DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
    const TwoTerms s = two_sum(a.high, b.high);
    // Even if the low parts outweigh s.value, it is a multiple of the unit in their last place, and
    // fast_two_sum is exact.
    const TwoTerms t = fast_two_sum(s.value, s.error + (a.low + b.low));
    return {t.value, t.error};
  }
  friend DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + (-b); }
  friend DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
    const TwoTerms p = two_product(a.high, b.high);
    const TwoTerms s = fast_two_sum(p.value, p.error + (a.high * b.low + a.low * b.high));
    return {s.value, s.error};
  }
};

struct DoubleDouble3 {
  DoubleDouble x, y, z;

  static DoubleDouble3 difference(const Vec3& a, const Vec3& b) {
    return {DoubleDouble::difference(a.x, b.x), DoubleDouble::difference(a.y, b.y),
            DoubleDouble::difference(a.z, b.z)};
  }
  bool is_double() const { return x.low == 0 && y.low == 0 && z.low == 0; }
  Vec3 rounded() const { return {x.rounded(), y.rounded(), z.rounded()}; }

  friend DoubleDouble3 operator+(const DoubleDouble3& a, const DoubleDouble3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend DoubleDouble3 operator*(DoubleDouble s, const DoubleDouble3& a) {
    return {s * a.x, s * a.y, s * a.z};
  }
  friend DoubleDouble dot(const DoubleDouble3& a, const DoubleDouble3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  friend DoubleDouble3 cross(const DoubleDouble3& a, const DoubleDouble3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
};

}  // namespace deliso
