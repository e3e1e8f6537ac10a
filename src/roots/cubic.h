// SPDX-License-Identifier: MIT
// Real roots of a cubic in an interval: what a voxel-ray intersection comes down to (paper §4.2).
// Two ways behind one interface: Schwarze 1990 (the paper's), and interval isolation after Marmitt
// et al. 2004. Both decide which roots exist in the same way, by the signs at the ends of the
// monotone pieces; they differ in how they get at a root (closed form and polish, or iteration).
//
// What is promised of solve_cubic. Let p be the polynomial with the very coefficients given, in
// exact arithmetic, w the power of two at or above max(|lo|, |hi|), and
//   E = kRootNoise * (|c0| + |c1| w + |c2| w^2 + |c3| w^3),
// a bound on the rounding error of evaluating p anywhere in the interval. Then
//   R1  at a reported root |p| <= E;
//   R2  no root is missed: between each root of p in [lo, hi] and some reported root |p| <= E;
//   R3  between two reported roots |p| exceeds E / 4: so a double or triple root, and a tangency
//       that passes or misses zero by no more than rounding, is reported once;
//   R4  none is invented: a reported root is in [lo, hi], and p changes sign there, or has a local
//       extremum or an end of the interval, within rounding (R1).
// In particular a sign change between two points with |p| > E is never missed. The zero polynomial
// has no isolated root: none is reported. pre: finite lo <= hi; no overflow in c[i] w^i.
#pragma once

#include <array>
#include <cstddef>

namespace deliso {

enum class CubicMethod { schwarze, isolation };

struct Roots {
  std::array<double, 3> t{};
  int count = 0;

  void push(double root) { t[static_cast<std::size_t>(count++)] = root; }
  const double* begin() const { return t.data(); }
  const double* end() const { return t.data() + count; }
  double front() const { return t[0]; }
  double back() const { return t[static_cast<std::size_t>(count - 1)]; }
};

// Power basis: c[0] + c[1] t + c[2] t^2 + c[3] t^3. Bernstein basis on [0, 1]: sum b[i] B_i(s),
// with b[0] and b[3] the values at 0 and 1.
using Cubic = std::array<double, 4>;

inline constexpr double kRootNoise = 0x1p-48;

// Real roots of c[0] + c[1] t + c[2] t^2 + c[3] t^3 in [lo, hi], increasing.
Roots solve_cubic(const Cubic& c, double lo, double hi, CubicMethod method);

// Where the cubic with Bernstein coefficients b passes from inside (>= 0) to outside (< 0) or back
// in [0, 1], increasing. Their number is odd exactly when the signs of b[0] and b[3] differ,
// however the rest is rounded; so crossings add up along a chain of cubics that share their end
// values. A touch is no crossing: it shows as none or as two (nearly) equal ones.
Roots crossings(const Cubic& b, CubicMethod method);

}  // namespace deliso
