// SPDX-License-Identifier: MIT
// The exact contour T for Stage 1: embedded.
//
// The pieces of a voxel are triangulated separately, so two may cross where they come close.
// Triangles of different voxels do not cross: they meet on the face between, in T's segments there.
// A voxel in which triangles cross, by exact predicates, is cut into cells, and into smaller ones
// until none cross. Cells are about as long as wide.
#pragma once

#include "contour/contour.h"
#include "volume/volume.h"

namespace deliso {

// Returns the fine contour. pre: `plain` is build_contour(volume, kappa); it is returned if it will
// do.
ContourMesh fine_contour(ContourMesh&& plain, const Volume& volume, double kappa);

}  // namespace deliso
