// SPDX-License-Identifier: MIT
// Facets at one edge, as the pages of a book at its spine: half planes from the edge ab through
// their third corners.
#pragma once

#include <cmath>

#include "exact/predicates.h"

namespace deliso {

// True if the pages of x, y and z follow each other in this order, counter-clockwise seen from b.
// Of the three angles from one to the next at most one exceeds pi if they turn once around the
// edge, and at most one does not if they turn twice.
inline bool are_in_order(const Vec3& a, const Vec3& b, const Vec3& x, const Vec3& y,
                         const Vec3& z) {
  return (orient3d(a, b, x, y) > 0) + (orient3d(a, b, y, z) > 0) + (orient3d(a, b, z, x) > 0) >= 2;
}

// Returns the cosine of the angle between the pages of x and y: 1 where they lie on each other.
inline double cosine_of_pages(const Vec3& a, const Vec3& b, const Vec3& x, const Vec3& y) {
  const Vec3 edge = b - a;
  const auto across = [&](const Vec3& p) {
    return p - a - dot(p - a, edge) / length2(edge) * edge;
  };
  const Vec3 u = across(x), v = across(y);
  return dot(u, v) / std::sqrt(length2(u) * length2(v));
}

}  // namespace deliso
