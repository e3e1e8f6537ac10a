// SPDX-License-Identifier: MIT
// The exact contour T as a mesh of the stages.
#pragma once

#include "contour/contour.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Returns T, with its vertices and triangles in their order. It has no duals yet. Its chain has all
// points of T's loops.
SurfaceMesh contour_as_mesh(const ContourMesh& contour);

}  // namespace deliso
