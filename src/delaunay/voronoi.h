// SPDX-License-Identifier: MIT
// The Voronoi diagram as the dual of the triangulation: edges of facets, vertices of cells.
//
// The Voronoi edge of a facet lies on the line through the facet's circumcenter c along its normal
// n: every point c + t n is equidistant from the facet's corners. It ends where it is as far from
// the fourth vertex d of a cell, at t = (|d-c|^2 - r^2) / (2 n.(d-c)). This needs no 3 x 3 solve,
// and the line does not depend on how flat the cells are.
//
// Accuracy, tested against exact solutions: c and the Voronoi vertices to 1e-9 of their distance
// from the corners, t to 1e-8 of it, plus the rounding of the coordinates themselves. Doubles
// suffice for facets and cells of decent shape; double-doubles serve the others. If even these
// cannot decide on which side of the facet d lies, the exact determinant does. Hence an end may be
// huge, even infinite, but has the right sign and is never NaN. The exception is a cell whose
// height is below 1e-25 of its size. Coordinates as in predicates.h, up to a magnitude of 1e40.
#pragma once

#include "base/vec3.h"
#include "delaunay/triangulation.h"

namespace deliso {

// The points equidistant from three corners: center + t * normal.
struct FacetLine {
  Vec3 center;  // of the circumcircle
  Vec3 normal;  // unit; the corners turn counter-clockwise seen from where it points
  Vec3 offset;  // center - a, with the digits that center loses far from the origin
  double radius = 0;
};

// Returns the line of the facet a, b, c. pre: a, b, c are not collinear.
FacetLine facet_line(const Vec3& a, const Vec3& b, const Vec3& c);

// Returns the t at which center + t * normal of facet_line(a, b, c) is as far from d as from a.
// pre: orient3d(a, b, c, d) != 0.
double equidistant_parameter(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                             const FacetLine& line);

// The Voronoi edge of a facet: center + t * normal for t in [t_lo, t_hi]. The line depends, bit for
// bit, on the facet's vertices alone, whichever of its cells names it. The normal sees them turn
// counter-clockwise from the lowest id to the highest. So parameters stay comparable while the
// facet lives, whatever is inserted around it.
struct FacetDual {
  Vec3 center, normal;
  double radius = 0;
  double t_lo = 0, t_hi = 0;  // t_lo <= t_hi; -+infinity at a cell at infinity

  Vec3 at(double t) const { return center + t * normal; }
};

// Returns the Voronoi edge of f. pre: the three vertices of f are finite.
FacetDual facet_dual(const Triangulation& t, Facet f);

// A Voronoi vertex, and its distance from the cell's four vertices.
struct Circumsphere {
  Vec3 center;
  double radius = 0;
};

// Returns the circumsphere. pre: orient3d(a, b, c, d) != 0.
Circumsphere circumsphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

// Returns the circumsphere of c. pre: c is finite.
Circumsphere circumsphere(const Triangulation& t, CellId c);

}  // namespace deliso
