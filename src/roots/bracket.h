// SPDX-License-Identifier: MIT
// What both cubic solvers share: evaluation, the critical points, and a root in a bracket.
#pragma once

#include <cmath>

#include "roots/cubic.h"

namespace deliso {

inline double horner(const Cubic& c, double t) {
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}
inline double horner_slope(const Cubic& c, double t) {
  return c[1] + t * (2 * c[2] + t * (3 * c[3]));
}

// The roots of the derivative inside (lo, hi), increasing. The larger root is taken from the sum
// without cancellation, the other from the product; where the cubic or the quadratic term vanishes
// they run off to infinity and fall out of the interval, so no case needs a threshold.
//
// Where rounding moves or loses them, nothing is lost: with discriminant d, moving by
// eps B^2 / (A sqrt d) changes the cubic's value by at most eps^1.5 times its coefficients.
inline Roots critical_points(const Cubic& c, double lo, double hi) {
  Roots points;
  const double a = 3 * c[3], b = c[2], discriminant = b * b - a * c[1];
  if (!(discriminant >= 0)) return points;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  double t0 = q / a, t1 = c[1] / q;
  if (t1 < t0) std::swap(t0, t1);
  if (lo < t0 && t0 < hi) points.push(t0);
  if (lo < t1 && t1 < hi && !(t0 == t1)) points.push(t1);
  return points;
}

// The root in [lo, hi], where the cubic goes from outside (< 0) to inside (>= 0), or the other way
// round when !rising. Newton steps from the guess t, kept in a shrinking bracket, with bisection
// where they leave it or fail to halve. It ends: each round halves the step or the bracket.
//
// The interval's width is at most about 1. A Newton step of size h leaves |p| <= |p''| h^2 / 2, so
// one of 2^-27 is the last; a bisection has to go on to the last bit, unless |p| is within `noise`.
inline double bracketed_root(const Cubic& c, double lo, double hi, bool rising, double t,
                             double noise) {
  double last_step = hi - lo;
  while (true) {
    const double f = horner(c, t);
    if (std::abs(f) <= noise) return t;
    ((f >= 0) == rising ? hi : lo) = t;
    double next = t - f / horner_slope(c, t);
    const bool newton = lo < next && next < hi && std::abs(next - t) <= 0.5 * last_step;
    if (!newton) next = lo + 0.5 * (hi - lo);
    const double step = std::abs(next - t);
    t = next;
    if (step <= (newton ? 0x1p-27 : 0x1p-53)) return t;
    last_step = newton ? step : hi - lo;
  }
}

// Where the chord between the values at the ends crosses zero.
inline double chord_guess(double lo, double hi, double f_lo, double f_hi) {
  const double t = lo + (hi - lo) * (f_lo / (f_lo - f_hi));
  return lo <= t && t <= hi ? t : 0.5 * (lo + hi);
}

}  // namespace deliso
