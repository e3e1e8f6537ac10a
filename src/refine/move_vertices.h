// SPDX-License-Identifier: MIT
// Vertices moved along Sigma. Where every insertion is refused and no flip helps, it is the
// vertices that stand badly: a facet stays over a limit, or outside the restricted Delaunay
// triangulation, which a corner a fraction of r_min further on would mend. (Refinement and moves
// taken together: Tournois, Wormser, Alliez and Desbrun 2009.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "surface/criteria.h"
#include "surface/surface_mesh.h"
#include "surface/report.h"
#include "isosurface/isosurface.h"

namespace deliso {

// Moves corners of facets that are over a limit, have no surface point, hold any vertex in their
// surface ball or, in guarded voxels (voxel_number()s), cross another, and vertices so held, while
// there are fewer or smaller such facets around them for it; how many moves. Facets keep their
// corners, no normal turns by 60 degrees, vertices on the mesh's boundary stay, and in guarded
// voxels nothing comes to cross.
// pre: no facet is dead.
std::size_t move_vertices(Recovered& recovered, const Isosurface& surface, const Criteria& criteria,
                          std::span<const std::uint64_t> guarded_voxels, Report& report);

}  // namespace deliso
