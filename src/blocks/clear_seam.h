// SPDX-License-Identifier: MIT
// Removes vertices from seams that the neighboring block does not know. The certificate may need
// any vertex of T. In a seam that may be a crossing of a cell's edge, in a split voxel. Such a
// vertex is merged into its neighbor on the seam. The gates of refine/refinement.h keep the mesh's
// topology and embedding.
#pragma once

#include "isosurface/isosurface.h"
#include "surface/boundary.h"
#include "surface/parameters.h"
#include "surface/report.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Removes the vertices from the seams that are not kept there (BoundaryCurves::is_kept), as far as
// the gates allow. Returns how many are left.
std::size_t clear_seam(SurfaceMesh& mesh, const Isosurface& surface, const BoundaryCurves& curves,
                       const Parameters& parameters, Report& report);

}  // namespace deliso
