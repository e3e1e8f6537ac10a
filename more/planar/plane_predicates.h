// SPDX-License-Identifier: MIT
// The two exact predicates of a planar Delaunay triangulation: the plane's counterpart of
// exact/predicates.h, with its range of coordinates. A filter decides first, then exact
// expansions; planar sets are small, so there is no stage between them.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/vec2.h"
#include "exact/predicates.h"

namespace deliso {

namespace predicates {

int orient2d_exact(const Vec2& a, const Vec2& b, const Vec2& c);
int incircle_exact(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

// As in exact/predicates.h. Shewchuk's bounds are (3 + 16 eps) eps and (10 + 96 eps) eps times
// the permanent. The products below bound a half of it; one more eps covers the rest.
inline constexpr double kOrient2dFilter = (3 * 2 + 1) * kEpsilon;
inline constexpr double kIncircleFilter = (10 * 2 + 1) * kEpsilon;

}  // namespace predicates

// Returns the sign of det[b-a, c-a]: 1, 0 or -1; 1 if a, b, c turn counter-clockwise.
inline int orient2d(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = b - a, v = c - a;
  const double det = u.x * v.y - u.y * v.x;
  const double scale =
      std::max(std::fabs(u.x), std::fabs(v.x)) * std::max(std::fabs(u.y), std::fabs(v.y));
  if (std::fabs(det) > predicates::kOrient2dFilter * scale) return (det > 0) - (det < 0);
  return predicates::orient2d_exact(a, b, c);
}

// Returns 1, 0 or -1 for d inside, on or outside the circle through a, b, c.
// pre: orient2d(a, b, c) > 0; if negative, the sign is reversed.
inline int incircle(const Vec2& pa, const Vec2& pb, const Vec2& pc, const Vec2& pd) {
  const Vec2 a = pa - pd, b = pb - pd, c = pc - pd;
  const double aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
  const double det =
      aa * (b.x * c.y - c.x * b.y) + bb * (c.x * a.y - a.x * c.y) + cc * (a.x * b.y - b.x * a.y);
  const double scale =
      (aa + bb + cc) * predicates::largest(a.x, b.x, c.x) * predicates::largest(a.y, b.y, c.y);
  if (std::fabs(det) > predicates::kIncircleFilter * scale) return (det > 0) - (det < 0);
  return predicates::incircle_exact(pa, pb, pc, pd);
}

}  // namespace deliso
