// SPDX-License-Identifier: MIT
// The closed form that the paper uses: Cubic and Quartic Roots (Schwarze, Graphics Gems I, 1990).
#pragma once

#include "roots/cubic.h"

namespace deliso {

// Returns all real roots of c, unordered and unpolished; a double root is listed once. At double
// and triple roots they may be off by the square or cube root of rounding. If the leading
// coefficient is below 2^-30 of the largest, the quadratic, then the linear formula takes over.
// That suits coefficients scaled to |t| <= 1: polishing mends what so small a term moves.
Roots closed_form_roots(const Cubic& c);

// Returns a guess for polishing: the root that lies in [lo, hi], or the nearest one, clamped.
double guess_from(const Roots& roots, double lo, double hi);

}  // namespace deliso
