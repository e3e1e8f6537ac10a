// SPDX-License-Identifier: MIT
// The exact contour T for Stage 1: embedded, with triangles about as long as wide.
//
// The pieces of a voxel are triangulated separately, so two may cross where they come close.
// Triangles of different voxels do not cross: they meet on the face between, in T's segments there.
// A voxel in which triangles cross, by exact predicates, is cut into cells, and into smaller ones
// until none cross. The accuracy of the labels depends on the density of T's vertices, so cells are
// about as long as wide. If the voxels are not, all of T is made of cells.
#pragma once

#include "contour/contour.h"
#include "volume/volume.h"

namespace deliso {

// Returns the fine contour. pre: `plain` is build_contour(volume, kappa); it is returned if it will
// do.
ContourMesh fine_contour(ContourMesh&& plain, const Volume& volume, double kappa);

}  // namespace deliso
