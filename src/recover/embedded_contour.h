// SPDX-License-Identifier: MIT
// The exact contour, split, without facets that cross. The pieces of a voxel are triangulated each
// by itself. Where a voxel beside a split one holds two pieces close to each other, the vertices
// that their loops have got from the split voxel can make the triangles cross: such voxels are
// split too.
#pragma once

#include "contour/contour.h"
#include "volume/volume.h"

namespace deliso {

// build_contour(volume, kappa, split), with `split.voxels` grown by voxels beside split ones until
// no two triangles of such a voxel cross.
ContourMesh build_embedded_contour(const Volume& volume, double kappa, ContourSplit& split);

}  // namespace deliso
