// SPDX-License-Identifier: MIT
// Interval isolation (Marmitt, Kleer, Wald, Friedrich and Slusallek 2004, Fast and Accurate
// Ray-Voxel Intersection Techniques): split the interval at the derivative's roots; on each
// monotone piece the signs at its ends tell whether it holds a root; find it by safeguarded steps.
#pragma once

#include "roots/bracket.h"
#include "roots/cubic.h"

namespace deliso {

// Roots of c in [lo, hi] within [-1, 1], by the rules R1-R4 of roots/cubic.h with w = 1. When
// `closed_form` is given, the steps start at the root found there, else on the chord.
Roots isolated_roots(const Cubic& c, double lo, double hi, const Roots* closed_form);

// crossings() of roots/cubic.h; `power` is b in the power basis.
Roots isolated_crossings(const Cubic& b, const Cubic& power, const Roots* closed_form,
                         Accuracy accuracy);

}  // namespace deliso
