// SPDX-License-Identifier: MIT
// Rounding to float and back to double.
#pragma once

#include "base/vec3.h"

namespace deliso {

// Returns x as a float. Not inlined: where GCC 12 vectorizes two of these conversions to float and
// back, at -O2, it leaves the rounding out.
[[gnu::noinline]] inline double to_float(double x) {
  return static_cast<float>(x);
}

inline Vec3 to_float(const Vec3& p) {
  return {to_float(p.x), to_float(p.y), to_float(p.z)};
}

}  // namespace deliso
