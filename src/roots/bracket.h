// SPDX-License-Identifier: MIT
// What both cubic solvers share: evaluation, the critical points, and a root in a bracket. Cubics
// are in the power basis.
#pragma once

#include <cmath>

#include "roots/cubic.h"

namespace deliso {

// Value and slope, in Estrin's order: a shorter chain of dependent operations than Horner's.
inline double value_at(const Cubic& c, double t) {
  return (c[0] + t * c[1]) + (t * t) * (c[2] + t * c[3]);
}
inline double slope_at(const Cubic& c, double t) {
  return (c[1] + t * (2 * c[2])) + (t * t) * (3 * c[3]);
}

// The roots of the derivative inside (0, 1), increasing. The larger root is taken from the sum
// without cancellation, the other from the product; where the cubic or the quadratic term vanishes
// they run off to infinity and fall out of the interval, so no case needs a threshold.
//
// Where rounding moves or loses them, nothing is lost: with discriminant d, moving by
// eps B^2 / (A sqrt d) changes the cubic's value by at most eps^1.5 times its coefficients.
inline Roots critical_points(const Cubic& c) {
  Roots points;
  const double a = 3 * c[3], b = c[2], discriminant = b * b - a * c[1];
  if (!(discriminant >= 0)) return points;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  double t0 = q / a, t1 = c[1] / q;
  if (t1 < t0) std::swap(t0, t1);
  if (0 < t0 && t0 < 1) points.push(t0);
  if (0 < t1 && t1 < 1 && !(t0 == t1)) points.push(t1);
  return points;
}

// When to stop. A Newton step of size h leaves |p| <= |p''| h^2 / 2, so one of at most `last_step`
// is the last; a bisection has to go on to the last bit (of an interval about 1 wide), unless |p|
// is within `noise`.
struct Accuracy {
  double last_step, noise;
};

// The root in [lo, hi], where the cubic goes from outside (< 0) to inside (>= 0), or the other way
// round when !rising: the signs at lo and hi are the caller's word, and nothing is computed there.
// Newton steps from the middle, kept in a shrinking bracket, with bisection where they leave it or
// fail to halve. It ends: each round halves the step or the bracket.
double bracketed_root(const Cubic& c, double lo, double hi, bool rising, Accuracy accuracy);

// The same where [lo, hi] holds no other root that rises (falls): as long as plain Newton steps
// halve and stay inside, no bracket is needed. Where they end at a root of the other kind, one at
// lo or hi or within rounding of them, or at a touch, where the slope is nothing but rounding, the
// bracket tells the two apart.
inline double single_root(const Cubic& c, double lo, double hi, bool rising, double guess,
                          Accuracy accuracy) {
  double t = guess, last_step = hi - lo;
  while (true) {
    const double slope = slope_at(c, t);
    const double next = t - value_at(c, t) / slope, step = std::abs(next - t);
    if (!(lo <= next && next <= hi && step <= 0.5 * last_step)) break;
    if (step <= accuracy.last_step) {
      if ((rising ? slope : -slope) > 0x1p7 * accuracy.noise) return next;
      break;
    }
    t = next;
    last_step = step;
  }
  return bracketed_root(c, lo, hi, rising, accuracy);
}

// Where the chord between the values at the ends crosses zero.
inline double chord_guess(double lo, double hi, double f_lo, double f_hi) {
  const double t = lo + (hi - lo) * (f_lo / (f_lo - f_hi));
  return lo <= t && t <= hi ? t : 0.5 * (lo + hi);
}

}  // namespace deliso
