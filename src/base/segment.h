// SPDX-License-Identifier: MIT
// The segment r(t) = a + t (b - a), t in [0, 1] (paper §4).
#pragma once

#include "base/vec3.h"

namespace deliso {

struct Segment {
  Vec3 a, b;
  Vec3 direction() const { return b - a; }
  Vec3 at(double t) const { return a + t * (b - a); }
};

}  // namespace deliso
