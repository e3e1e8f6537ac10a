// SPDX-License-Identifier: MIT
// Measures of a triangle in space: the r, l and circumcenter of the paper's criteria (§3.1).
#pragma once

#include <algorithm>

#include "base/vec3.h"

namespace deliso {

// Twice the area times the unit normal; counter-clockwise seen from where it points.
constexpr Vec3 area_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  return cross(b - a, c - a);
}

// Circumcenter in the triangle's plane. Infinite or NaN for collinear corners.
inline Vec3 circumcenter(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a, n = cross(u, v);
  return a + (length2(u) * cross(v, n) + length2(v) * cross(n, u)) / (2 * length2(n));
}

constexpr double shortest_edge2(const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::min({distance2(a, b), distance2(b, c), distance2(c, a)});
}

}  // namespace deliso
