// SPDX-License-Identifier: MIT
#include "roots/schwarze.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/elementary.h"

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

// Returns cos(acos(x) / 3) for x in [0, 1]: where 4 c^3 - 3 c = x. Three Newton steps from the
// chord, which is within 0.01. The system library's cos and acos differ between processors.
double cosine_of_third(double x) {
  double c = 0.5 * std::numbers::sqrt3 + (1 - 0.5 * std::numbers::sqrt3) * x;
  for (int step = 0; step < 3; ++step) c -= (c * (4 * c * c - 3) - x) / (12 * c * c - 3);
  return std::min(c, 1.0);
}

// Returns the real roots of y^3 + 3 p y + 2 q = 0.
Roots depressed_roots(double p, double q) {
  Roots roots;
  const double cube = p * p * p, discriminant = q * q + cube;
  if (discriminant > 0) {
    const double root = std::sqrt(discriminant);
    // First the summand without cancellation, then the other from u v = -p.
    const double u = -std::copysign(cube_root(std::abs(q) + root), q);
    roots.push(u - p / u);
  } else if (discriminant < 0) {
    // Schwarze has y = scale cos(phi), with cos(3 phi) = -q / sqrt(-p^3), and phi + 2 n pi / 3.
    const double scale = std::copysign(2 * std::sqrt(-p), -q);
    const double c = cosine_of_third(std::min(std::abs(q) / std::sqrt(-cube), 1.0));
    const double half = 0.5 * c, rest = 0.5 * std::numbers::sqrt3 * std::sqrt(1 - c * c);
    roots.push(scale * c);
    roots.push(scale * (rest - half));
    roots.push(-scale * (rest + half));
  } else if (q == 0) {
    roots.push(0);
  } else {
    const double u = cube_root(-q);
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
    for (int n = 0; n < roots.count; ++n) roots.t[n] -= third;
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
