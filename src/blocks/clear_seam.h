// SPDX-License-Identifier: MIT
// The certificate may ask for any vertex of T, also for one in a seam that the block beyond knows
// nothing of: a crossing of a cell's edge, where a voxel was cut. Those are taken out again, each
// merged into its neighbor on the seam behind the gates of refine/refinement.h, so that the mesh
// keeps its topology and stays embedded.
#pragma once

#include "isosurface/isosurface.h"
#include "surface/boundary.h"
#include "surface/parameters.h"
#include "surface/report.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Takes out of the seams what is not kept there (BoundaryCurves::is_kept), as far as the gates
// allow. Returns how much is left.
std::size_t clear_seam(SurfaceMesh& mesh, const Isosurface& surface, const BoundaryCurves& curves,
                       const Parameters& parameters, Report& report);

}  // namespace deliso
