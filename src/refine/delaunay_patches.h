// SPDX-License-Identifier: MIT
// Flips of more than two facets. Where a facet's surface ball holds another vertex and no flip of
// an edge helps, a patch of facets around it is triangulated anew, over the same rim and the same
// vertices, by facets whose surface balls are empty: a piece of the restricted Delaunay
// triangulation, found from the balls alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "surface/criteria.h"
#include "surface/surface_mesh.h"
#include "surface/report.h"
#include "isosurface/isosurface.h"

namespace deliso {

// Replaces patches while it finds any; how many. A patch is a disk and becomes a disk, so the
// topology stays. No new facet has a vertex of the patch or next to it in its surface ball, and in
// guarded voxels (voxel_number()s) none crosses another.
std::size_t make_patches_delaunay(Recovered& recovered, const Isosurface& surface,
                                  const Criteria& criteria,
                                  std::span<const std::uint64_t> guarded_voxels, Report& report);

}  // namespace deliso
