// SPDX-License-Identifier: MIT
// Into how many cells the certified way cuts voxels (contour/split_voxels.h). What the labels can
// tell depends on how densely T's vertices stand, so cells are to be about as long as wide, and
// where Stage 2 was in trouble as small as the smallest facet that the criteria care for. Both give
// way where T would grow beyond bounds.
#pragma once

#include <cstddef>

#include "volume/volume.h"

namespace deliso {

// Everywhere: one cell a voxel unless that is more than about twice as long as wide.
// `active`: voxels that Sigma meets; `plain_vertices`: of T when no voxel is cut.
Index3 cells_elsewhere(Vec3 spacing, std::size_t active, std::size_t plain_vertices);

// Of `listed` voxels where there was trouble: cells of r_min, but at least two a side.
Index3 cells_at_trouble(Vec3 spacing, double r_min, std::size_t listed, std::size_t plain_vertices);

}  // namespace deliso
