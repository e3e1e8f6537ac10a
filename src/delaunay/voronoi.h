// SPDX-License-Identifier: MIT
// The Voronoi diagram as the dual of the triangulation: edges of facets, vertices of cells.
//
// The Voronoi edge of a facet lies on the line through the facet's circumcenter c along its normal
// n: every point c + t n is equidistant from the facet's corners. It ends where it is as far from
// the fourth vertex d of a cell, at t = (|d-c|^2 - r^2) / (2 n.(d-c)). This takes no 3 x 3 solve,
// and the line does not depend on how flat the cells are.
//
// Accuracy: c and the Voronoi vertices to 1e-9 of their distance from the corners, t to 1e-8 of it,
// plus the rounding of the coordinates themselves (tested against exact solutions). Doubles serve
// for facets and cells of decent shape, double-doubles for the others, and where even these cannot
// tell on which side of the facet d lies, the exact determinant does. Hence an end may be huge,
// even infinite, but has the right sign and is never NaN, short of cells whose height is below
// 1e-25 of their size. Coordinates as in predicates.h, up to a magnitude of 1e40.
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

// pre: a, b, c not on one line.
FacetLine facet_line(const Vec3& a, const Vec3& b, const Vec3& c);

// The t at which center + t * normal of facet_line(a, b, c) is as far from d as from a.
// pre: orient3d(a, b, c, d) != 0.
double equidistant_parameter(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                             const FacetLine& line);

// The Voronoi edge of a facet: center + t * normal for t in [t_lo, t_hi]. The line depends on the
// facet's vertices alone (the normal sees them turn counter-clockwise from the lowest id to the
// highest), bit for bit, whichever of its cells names the facet and whatever is inserted around
// it, so that parameters stay comparable while the facet lives.
struct FacetDual {
  Vec3 center, normal;
  double radius = 0;
  double t_lo = 0, t_hi = 0;  // t_lo <= t_hi; -+infinity at a cell at infinity
  bool cell_at_lo = false;    // whether the t_lo end is that of f.cell, the t_hi end its mirror's

  Vec3 at(double t) const { return center + t * normal; }
};

// pre: the three vertices of f are finite.
FacetDual facet_dual(const Triangulation& t, Facet f);

// A Voronoi vertex, and its distance from the cell's four vertices.
struct Circumsphere {
  Vec3 center;
  double radius = 0;
};

// pre: orient3d(a, b, c, d) != 0.
Circumsphere circumsphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

// pre: c is finite.
Circumsphere circumsphere(const Triangulation& t, CellId c);

}  // namespace deliso
