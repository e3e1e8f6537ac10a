// SPDX-License-Identifier: MIT
// Where a cubic passes zero in [0, 1]. Every voxel-ray intersection reduces to this (paper §4.2).
// There are two methods: Schwarze 1990 (the paper's), and interval isolation (Marmitt, Kleer, Wald,
// Friedrich and Slusallek 2004, Fast and Accurate Ray-Voxel Intersection Techniques). Both split
// the interval at the derivative's roots. On each monotone piece the signs at its ends decide
// whether it holds a root. The methods differ in how they find it: closed form and polish, or
// iteration.
#pragma once

#include <array>
#include <cstddef>

namespace deliso {

enum class CubicMethod { schwarze, isolation };

struct Roots {
  std::array<double, 3> t{};
  int count = 0;
  bool from_inside = false;  // the cubic is at least 0 where t is 0

  // True if the cubic passes to outside at root n: passages alternate.
  bool leaves(int n) const { return from_inside == (n % 2 == 0); }
  void push(double root) { t[count++] = root; }
  const double* begin() const { return t.data(); }
  const double* end() const { return t.data() + count; }
};

// Bernstein basis on [0, 1]: sum b[i] B_i(t), with b[0] and b[3] the values at 0 and 1. Functions
// that say so use the power basis: c[0] + c[1] t + c[2] t^2 + c[3] t^3.
using Cubic = std::array<double, 4>;

// Returns where the cubic with Bernstein coefficients b passes from inside (>= 0) to outside (< 0)
// or back, increasing in [0, 1]. Their number is odd exactly when the signs of b[0] and b[3]
// differ, whatever the rounding of the rest. So the numbers add up along a chain of cubics that
// share end values. A touch is no crossing: it shows as none or as two (nearly) equal ones.
Roots crossings(const Cubic& b, CubicMethod method);

}  // namespace deliso
