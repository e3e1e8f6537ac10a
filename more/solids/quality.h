// SPDX-License-Identifier: MIT
// The shape of a tetrahedron: the least sine of its six dihedral angles. It is small where an angle
// is near 0 and where one is near 180 degrees.
#pragma once

#include "more/solids/cell_mesh.h"

namespace deliso {

// Returns the least sine, below 0 if the cell is not positively oriented (exact).
double shape(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

inline double shape(const CellMesh& mesh, const Tetrahedron& v) {
  const auto& p = mesh.points;
  return shape(p[v[0]], p[v[1]], p[v[2]], p[v[3]]);
}

}  // namespace deliso
