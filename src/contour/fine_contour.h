// SPDX-License-Identifier: MIT
// The exact contour T as Stage 1 wants it: embedded, and of triangles about as long as wide.
//
// The pieces of a voxel are triangulated each by itself, so two of them may cross where they come
// close. Triangles of different voxels do not: they meet on the face between, in T's segments
// there. A voxel in which triangles cross, by exact predicates, is cut into cells, and into smaller
// ones while they cross. What the labels can tell depends on how densely T's vertices stand, so
// cells are about as long as wide, and all of T is made of such where voxels are not.
#pragma once

#include "contour/contour.h"
#include "volume/volume.h"

namespace deliso {

// Takes the plain contour, build_contour(volume, kappa), and gives it back where it will do.
ContourMesh fine_contour(ContourMesh&& plain, const Volume& volume, double kappa, int threads = 1);

}  // namespace deliso
