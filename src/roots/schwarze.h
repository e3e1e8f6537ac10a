// SPDX-License-Identifier: MIT
// Cubic and Quartic Roots (Schwarze, Graphics Gems I, 1990): the closed form the paper uses.
#pragma once

#include "roots/cubic.h"

namespace deliso {

// All real roots of c, in no order, as the closed form gives them: unpolished, so they may be off
// by the square or cube root of rounding at double and triple roots. A leading coefficient below
// 2^-30 of the largest falls back to the quadratic, then to the linear formula: meant for
// coefficients scaled to |t| <= 1, where such a term moves the roots within less than polish
// mends. A double root is listed once.
Roots closed_form_roots(const Cubic& c);

// The one of `roots` that lies in [lo, hi], clamped to it if none does: a guess for polishing.
double guess_from(const Roots& roots, double lo, double hi);

}  // namespace deliso
