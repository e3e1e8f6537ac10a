// SPDX-License-Identifier: MIT
#include "roots/cubic.h"

#include <algorithm>
#include <cmath>

#include "roots/bracket.h"
#include "roots/isolation.h"
#include "roots/schwarze.h"

namespace deliso {
namespace {

// The same polynomial in x with t = 2^exponent x, its largest coefficient brought to [1/2, 1):
// powers of two, so not a bit is lost.
Cubic rescaled(Cubic c, int exponent) {
  double largest = 0;
  for (int n = 0; n < 4; ++n) {
    double& a = c[static_cast<std::size_t>(n)];
    a = std::ldexp(a, n * exponent);
    largest = std::max(largest, std::abs(a));
  }
  if (largest == 0) return c;
  const int shift = -(std::ilogb(largest) + 1);
  for (double& a : c) a = std::ldexp(a, shift);
  return c;
}

}  // namespace

Roots solve_cubic(const Cubic& c, double lo, double hi, CubicMethod method) {
  const double reach = std::max(std::abs(lo), std::abs(hi));
  int exponent = 0;
  if (reach > 0 && std::frexp(reach, &exponent) == 0.5) --exponent;
  const Cubic unit = rescaled(c, exponent);
  const double unit_lo = std::ldexp(lo, -exponent), unit_hi = std::ldexp(hi, -exponent);

  Roots roots;
  if (method == CubicMethod::schwarze) {
    const Roots closed_form = closed_form_roots(unit);
    roots = isolated_roots(unit, unit_lo, unit_hi, &closed_form);
  } else {
    roots = isolated_roots(unit, unit_lo, unit_hi, nullptr);
  }
  for (double& t : roots.t) t = std::ldexp(t, exponent);
  return roots;
}

Roots crossings(const Cubic& b, CubicMethod method) {
  // The control polygon crosses zero at least as often as the curve, and as often modulo two.
  const bool inside[] = {b[0] >= 0, b[1] >= 0, b[2] >= 0, b[3] >= 0};
  const int changes =
      (inside[0] != inside[1]) + (inside[1] != inside[2]) + (inside[2] != inside[3]);
  if (changes == 0) return {};
  const Cubic power = {b[0], 3 * (b[1] - b[0]), 3 * (b[0] - 2 * b[1] + b[2]),
                       (b[3] - b[0]) + 3 * (b[1] - b[2])};
  const bool closed = method == CubicMethod::schwarze;
  Roots closed_form;
  if (closed) closed_form = closed_form_roots(power);
  // |p''| / 2 <= 12 max |b|: a step of 2^-20 leaves 1.1e-11 of it.
  const Accuracy accuracy{0x1p-20, 0x1p-53 * (std::abs(b[0]) + std::abs(b[3]))};
  if (changes > 1) return isolated_crossings(b, power, closed ? &closed_form : nullptr, accuracy);

  // One change of sign is one crossing, and needs no splitting.
  const double guess = closed ? guess_from(closed_form, 0, 1) : b[0] / (b[0] - b[3]);
  Roots roots;
  roots.push(single_root(power, 0, 1, inside[3], guess, accuracy));
  return roots;
}

}  // namespace deliso
