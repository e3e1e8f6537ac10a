// SPDX-License-Identifier: MIT
// The orientation of components that end on the box, by their boundary. A coarse facet may stand
// across the gradient of g anywhere, so gradients inside the box tell nothing of it.
#pragma once

#include <vector>

#include "check/validity.h"
#include "contour/contour.h"
#include "isosurface/isosurface.h"

namespace deliso {

// Returns per component of the mesh a number whose sign is that of its orientation: negative if it
// is reversed, 0 if its boundary does not tell. `stands_for`: its component of T, or kNoId.
// `tolerance`: of vertices on Sigma.
//
// Where a boundary passes from one face of the box to another, g grows along the edge of the box
// towards the side of the boundary that is inside. A boundary that never passes an edge of the box
// consists of loops within faces: they enclose areas of the same sign as those of T do.
std::vector<double> boundary_orientations(const CleanMesh& mesh,
                                          const std::vector<std::uint32_t>& stands_for,
                                          const ContourMesh& contour, const Isosurface& surface,
                                          double tolerance);

}  // namespace deliso
