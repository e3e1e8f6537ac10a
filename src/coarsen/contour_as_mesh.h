// SPDX-License-Identifier: MIT
// The exact contour T as a mesh of the stages, and its ends on the box as boundary curves.
#pragma once

#include "contour/contour.h"
#include "surface/boundary.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Returns T, with its vertices and triangles in their order: vertex n of the mesh is vertex n of T.
// It has no duals yet. Its chain has all points of the curves below.
SurfaceMesh contour_as_mesh(const ContourMesh& contour);

// Returns the curves in which T ends on the box. Those on `inner` faces (bit f for face f) are
// fixed, and all their points kept: the neighboring block has the same.
BoundaryLoops boundary_loops(const ContourMesh& contour, unsigned inner = 0);

}  // namespace deliso
