// SPDX-License-Identifier: MIT
// Facets at one edge, as the pages of a book at its spine.
#pragma once

#include "delaunay/predicates.h"

namespace deliso {

// True if half planes from the edge ab through x, y and z follow each other in this order,
// counter-clockwise seen from b. Of the three angles from one to the next at most one exceeds pi if
// they turn once around the edge, and at most one does not if they turn twice.
inline bool are_in_order(const Vec3& a, const Vec3& b, const Vec3& x, const Vec3& y,
                         const Vec3& z) {
  return (orient3d(a, b, x, y) > 0) + (orient3d(a, b, y, z) > 0) + (orient3d(a, b, z, x) > 0) >= 2;
}

}  // namespace deliso
