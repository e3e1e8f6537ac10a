// SPDX-License-Identifier: MIT
// Exercise 2, two hours: which cells does a point outside the hull destroy?
//
// A cell of a Delaunay triangulation is in conflict with p if p is strictly inside its sphere; the
// insertion of p replaces just these cells (§2.2.1; Bowyer 1981, Watson 1981). Outside the convex
// hull lie infinite cells: three corners on the hull, and vertex 0, which is infinite. Think of its
// sphere as the limit of spheres through the three corners, as the fourth goes outwards for ever.
// Its inside is then the half space beyond the hull facet, and one more set of points. Which?
//
// `corners(c)` has the addresses of a cell's four points; that of the infinite vertex means
// nothing. orient3d(a, b, c, d) is the sign of the volume of a tetrahedron, and a cell of the
// triangulation is positive. So is an infinite one, with a point beyond its hull facet in the place
// of vertex 0. The finite cell behind the hull facet is neighbor(c, 0). No epsilon: both predicates
// are exact.
//
// Hint: p may lie in the plane of the hull facet, as points of grids often do. The sphere of which
// cell cuts that plane in the facet's circumcircle?
bool Triangulation::is_in_conflict(CellId c, const Vec3& p) const {
  const std::array<const Vec3*, 4> v = corners(c);
  if (!is_infinite(c)) return insphere(*v[0], *v[1], *v[2], *v[3], p) > 0;
  throw std::logic_error("exercise 2: your work");
}
