// SPDX-License-Identifier: MIT
// Shared by both cubic solvers: evaluation, critical points, and a root in a bracket. Cubics are in
// the power basis.
#pragma once

#include <cmath>

#include "roots/cubic.h"

namespace deliso {

// Return value and slope, in Estrin's order: a shorter chain of dependent operations than Horner's.
inline double value_at(const Cubic& c, double t) {
  return (c[0] + t * c[1]) + (t * t) * (c[2] + t * c[3]);
}
inline double slope_at(const Cubic& c, double t) {
  return (c[1] + t * (2 * c[2])) + (t * t) * (3 * c[3]);
}

// Returns the roots of the derivative inside (0, 1), increasing. The larger root comes from the sum
// without cancellation, the other from the product. If the cubic or the quadratic term vanishes,
// they run off to infinity and out of the interval, so no case needs a threshold.
//
// Rounding may move or lose critical points, but no crossing. With discriminant d, a move by eps
// B^2 / (A sqrt d) changes the cubic's value by at most eps^1.5 times its coefficients.
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

// When to stop. A Newton step of size h leaves |p| <= |p''| h^2 / 2, so a step of at most
// `last_step` is the last. A bisection has to go on to the last bit (of an interval about 1 wide),
// unless |p| is within `noise`.
struct Accuracy {
  double last_step, noise;
};

// Returns the root in [lo, hi] at which the cubic goes from outside (< 0) to inside (>= 0), or back
// if !rising. The caller vouches for the signs at lo and hi; nothing is computed there. Takes
// Newton steps from the middle, in a shrinking bracket, and bisects where they leave it or fail to
// halve. It terminates: each round halves the step or the bracket.
double bracketed_root(const Cubic& c, double lo, double hi, bool rising, Accuracy accuracy);

// As bracketed_root. pre: [lo, hi] holds no other root that rises (falls). No bracket is needed as
// long as plain Newton steps halve and stay inside. They may end at a root of the other kind, at lo
// or hi or within rounding of them. They may also end at a touch, where the slope is only rounding.
// The bracket then decides.
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

// Returns where the chord between the values at the ends crosses zero.
inline double chord_guess(double lo, double hi, double f_lo, double f_hi) {
  const double t = lo + (hi - lo) * (f_lo / (f_lo - f_hi));
  return lo <= t && t <= hi ? t : 0.5 * (lo + hi);
}

}  // namespace deliso
