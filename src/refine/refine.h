// SPDX-License-Identifier: MIT
// Stage 2, RefineGeom of paper Figure 9: points are added to the plain mesh until every facet with
// r > r_min has h/r, r/h_sigma and r/l within bounds.
//
// An insertion is only done when it keeps the mesh a manifold that follows Sigma: the encroached
// facets are a disk (mesh/encroach.h), every new facet finds its surface point within its
// circumradius, and no new normal runs along the gradient there. Otherwise it is refused and
// counted. Euler number and components stay those of Stage 1.
#pragma once

#include <cstdint>
#include <span>

#include "surface/criteria.h"
#include "surface/surface_mesh.h"
#include "surface/report.h"

namespace deliso {

// Refines `recovered` in place. In the guarded voxels (voxel_number()s) no facet is made that
// crosses another. Throws InputError at options.max_vertices unless options.keep_partial.
void refine_geom(Recovered& recovered, const Isosurface& surface, const BoundaryCurves& curves,
                 const Criteria& criteria, std::span<const std::uint64_t> guarded_voxels,
                 const Options& options, Report& report);

}  // namespace deliso
