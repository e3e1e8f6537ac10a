// SPDX-License-Identifier: MIT
#include "roots/isolation.h"

#include <algorithm>
#include <cmath>

#include "roots/bracket.h"
#include "roots/schwarze.h"

namespace deliso {
namespace {

// Ends of the monotone pieces and the values there.
struct Ends {
  std::array<double, 4> t, f;
  std::size_t count = 0;

  void push(double at, double value) {
    t[count] = at;
    f[count++] = value;
  }
};

double root_between(const Cubic& c, const Ends& ends, std::size_t i, std::size_t j,
                    const Roots* closed_form, Accuracy accuracy) {
  const double lo = ends.t[i], hi = ends.t[j];
  const double guess =
      closed_form ? guess_from(*closed_form, lo, hi) : chord_guess(lo, hi, ends.f[i], ends.f[j]);
  return single_root(c, lo, hi, ends.f[j] >= 0, guess, accuracy);
}

}  // namespace

Roots isolated_roots(const Cubic& c, double lo, double hi, const Roots* closed_form) {
  Roots roots;
  const double size = std::abs(c[0]) + std::abs(c[1]) + std::abs(c[2]) + std::abs(c[3]);
  if (size == 0) return roots;
  // Below half of E: what rounding adds to a value at a true zero, and E itself, stay within E.
  const double small = 0.5 * kRootNoise * size;
  // |p''| / 2 <= 3 size.
  const Accuracy accuracy{0x1p-27, 0x1p-54 * size};

  Ends ends;
  ends.push(lo, value_at(c, lo));
  for (const double t : critical_points(c, lo, hi)) ends.push(t, value_at(c, t));
  if (hi > lo) ends.push(hi, value_at(c, hi));
  const auto is_small = [&](std::size_t n) { return std::abs(ends.f[n]) <= small; };
  const auto inside = [&](std::size_t n) { return ends.f[n] >= 0; };

  for (std::size_t i = 0; i < ends.count; ++i) {
    if (!is_small(i)) {
      if (i + 1 < ends.count && !is_small(i + 1) && inside(i) != inside(i + 1))
        roots.push(root_between(c, ends, i, i + 1, closed_form, accuracy));
      continue;
    }
    // A run of ends within rounding of zero is one root (R3): a crossing when the signs beyond it
    // differ, else a touch where |p| is smallest.
    std::size_t j = i, least = i;
    while (j + 1 < ends.count && is_small(j + 1)) ++j;
    for (std::size_t n = i; n <= j; ++n)
      if (std::abs(ends.f[n]) < std::abs(ends.f[least])) least = n;
    const std::size_t before = i > 0 ? i - 1 : i, after = j + 1 < ends.count ? j + 1 : j;
    if (inside(before) != inside(after) && ends.f[least] != 0)
      roots.push(root_between(c, ends, before, after, closed_form, accuracy));
    else
      roots.push(ends.t[least]);
    i = j;
  }
  return roots;
}

Roots isolated_crossings(const Cubic& b, const Cubic& power, const Roots* closed_form,
                         Accuracy accuracy) {
  Ends ends;
  ends.push(0, b[0]);
  for (const double t : critical_points(power, 0, 1)) ends.push(t, value_at(power, t));
  ends.push(1, b[3]);

  Roots roots;
  for (std::size_t n = 0; n + 1 < ends.count; ++n)
    if ((ends.f[n] >= 0) != (ends.f[n + 1] >= 0))
      roots.push(root_between(power, ends, n, n + 1, closed_form, accuracy));
  return roots;
}

}  // namespace deliso
