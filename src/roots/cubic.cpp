// SPDX-License-Identifier: MIT
#include "roots/cubic.h"

#include <cmath>

#include "roots/bracket.h"
#include "roots/schwarze.h"

namespace deliso {

Roots crossings(const Cubic& b, CubicMethod method) {
  // The control polygon crosses zero at least as often as the curve, and the difference is even.
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

  Roots roots;
  roots.from_inside = inside[0];
  double t = 0, f = b[0];
  const auto add_piece = [&](double end, double f_end) {
    if ((f >= 0) != (f_end >= 0)) {
      const double guess = closed ? guess_from(closed_form, t, end) : chord_guess(t, end, f, f_end);
      roots.push(single_root(power, t, end, f_end >= 0, guess, accuracy));
    }
    t = end;
    f = f_end;
  };
  // One change of sign is one crossing and needs no splitting.
  if (changes > 1) {
    for (const double end : critical_points(power)) add_piece(end, value_at(power, end));
  }
  add_piece(1, b[3]);
  return roots;
}

}  // namespace deliso
