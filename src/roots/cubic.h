// SPDX-License-Identifier: MIT
// Where a cubic passes zero in [0, 1]: what a voxel-ray intersection comes down to (paper §4.2).
// Two ways behind one interface: Schwarze 1990 (the paper's), and interval isolation (Marmitt,
// Kleer, Wald, Friedrich and Slusallek 2004, Fast and Accurate Ray-Voxel Intersection Techniques):
// split the interval at the derivative's roots; on each monotone piece the signs at its ends tell
// whether it holds a root. These signs decide which roots exist in both; they differ in how they
// get at one (closed form and polish, or iteration).
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

// Bernstein basis on [0, 1]: sum b[i] B_i(t), with b[0] and b[3] the values at 0 and 1. Where it
// says so, power basis: c[0] + c[1] t + c[2] t^2 + c[3] t^3.
using Cubic = std::array<double, 4>;

// Where the cubic with Bernstein coefficients b passes from inside (>= 0) to outside (< 0) or back
// in [0, 1], increasing. Their number is odd exactly when the signs of b[0] and b[3] differ,
// however the rest is rounded; so crossings add up along a chain of cubics that share their end
// values. A touch is no crossing: it shows as none or as two (nearly) equal ones.
Roots crossings(const Cubic& b, CubicMethod method);

}  // namespace deliso
