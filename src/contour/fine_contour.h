// SPDX-License-Identifier: MIT
// The exact contour T for Stage 1: embedded.
//
// The pieces of a voxel are triangulated separately, so two may cross where they come close.
// Triangles of different voxels do not cross: they meet on the face between, in T's segments there.
// A voxel in which triangles cross, by exact predicates, is cut into cells, and into smaller ones
// until none cross. Cells are about as long as wide.
//
// All voxels that are much longer than wide are cut, too, across their length: Stage 1 only removes
// vertices, so what T lacks along a long side, Stage 2 would have to insert.
#pragma once

#include "contour/contour.h"
#include "volume/volume.h"

namespace deliso {

// Returns how many cells voxels are cut into, along each axis: 1 unless they are three times as
// long there as their shortest side.
Index3 cells_of_long_voxels(const Vec3& spacing);

// Returns the fine contour. `cells`: of all voxels. pre: `begun` is build_contour() with these
// cells; it is returned if it will do.
ContourMesh fine_contour(ContourMesh&& begun, const Volume& volume, double kappa,
                         Index3 cells = {1, 1, 1});

}  // namespace deliso
