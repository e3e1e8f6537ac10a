// SPDX-License-Identifier: MIT
#include "roots/schwarze.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace deliso {
namespace {

Roots quadratic_roots(double c0, double c1, double c2) {
  Roots roots;
  const double half = 0.5 * c1, discriminant = half * half - c2 * c0;
  if (discriminant < 0) return roots;
  const double q = -(half + std::copysign(std::sqrt(discriminant), half));
  roots.push(q / c2);
  if (discriminant > 0) roots.push(c0 / q);
  return roots;
}

// Returns the real roots of y^3 + 3 p y + 2 q = 0.
Roots depressed_roots(double p, double q) {
  Roots roots;
  const double cube = p * p * p, discriminant = q * q + cube;
  if (discriminant > 0) {
    const double root = std::sqrt(discriminant);
    // First the summand without cancellation, then the other from u v = -p.
    const double u = -std::copysign(std::cbrt(std::abs(q) + root), q);
    roots.push(u - p / u);
  } else if (discriminant < 0) {
    const double phi = std::acos(std::clamp(-q / std::sqrt(-cube), -1.0, 1.0)) / 3;
    const double scale = 2 * std::sqrt(-p);
    roots.push(scale * std::cos(phi));
    roots.push(-scale * std::cos(phi + std::numbers::pi / 3));
    roots.push(-scale * std::cos(phi - std::numbers::pi / 3));
  } else if (q == 0) {
    roots.push(0);
  } else {
    const double u = std::cbrt(-q);
    roots.push(2 * u);
    roots.push(-u);
  }
  return roots;
}

}  // namespace

Roots closed_form_roots(const Cubic& c) {
  const double tiny =
      0x1p-30 * std::max({std::abs(c[0]), std::abs(c[1]), std::abs(c[2]), std::abs(c[3])});
  Roots roots;
  if (std::abs(c[3]) > tiny) {
    const double a2 = c[2] / c[3], a1 = c[1] / c[3], a0 = c[0] / c[3], third = a2 / 3;
    const double p = a1 / 3 - third * third;
    const double q = third * third * third - 0.5 * third * a1 + 0.5 * a0;
    roots = depressed_roots(p, q);
    for (int n = 0; n < roots.count; ++n) roots.t[static_cast<std::size_t>(n)] -= third;
  } else if (std::abs(c[2]) > tiny) {
    roots = quadratic_roots(c[0], c[1], c[2]);
  } else if (std::abs(c[1]) > tiny) {
    roots.push(-c[0] / c[1]);
  }
  return roots;
}

double guess_from(const Roots& roots, double lo, double hi) {
  double best = 0.5 * (lo + hi), off = HUGE_VAL;
  for (const double root : roots) {
    const double inside = std::clamp(root, lo, hi);
    if (std::abs(root - inside) >= off) continue;
    off = std::abs(root - inside);
    best = inside;
  }
  return best;
}

}  // namespace deliso
