// SPDX-License-Identifier: MIT
// Stage 1 may hand over vertices very close to each other: the curve on the box and the surface
// inside are sampled by different rules. Stage 2 only inserts, so the needles there would stay.
// Before it begins, and again when finer facets leave more room, edges shorter than a triangle of
// r_min may have are collapsed.
#pragma once

#include <cstdint>
#include <span>

#include "surface/boundary.h"
#include "surface/criteria.h"
#include "surface/surface_mesh.h"
#include "surface/report.h"

namespace deliso {

// Collapses edges at the boundary that are shorter than r_min / lambda and belong to a triangle
// with r/l > lambda; vertices on edges of the box stay, others of the boundary only go along it.
// Topology is kept; every changed facet with r > r_min finds its surface point, no normal turns
// much, and in guarded voxels (voxel_number()s) no changed facet crosses another.
void collapse_needles(Recovered& recovered, const Isosurface& surface, const BoundaryCurves& curves,
                      const Criteria& criteria, std::span<const std::uint64_t> guarded_voxels,
                      Report& report);

}  // namespace deliso
