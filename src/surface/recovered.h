// SPDX-License-Identifier: MIT
// What Stage 1 hands over, whichever way it went: nothing of tetrahedra, labels or voxels.
#pragma once

#include <vector>

#include "surface/parameters.h"
#include "surface/report.h"
#include "surface/surface_mesh.h"

namespace deliso {

struct Recovered {
  SurfaceMesh mesh;
  BoundaryCurves curves;        // that its chain is on
  std::vector<Vec3> witnesses;  // points of Sigma, dense: the vertices of T (contour/)
};

}  // namespace deliso
