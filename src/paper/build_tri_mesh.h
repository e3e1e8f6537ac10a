// SPDX-License-Identifier: MIT
// BuildTriMesh (paper §3.2): Del S|Sigma as a mesh of its own.
#pragma once

#include <vector>

#include "paper/restricted.h"
#include "surface/surface_mesh.h"

namespace deliso {

// `poles` are per vertex of the triangulation, or none. Facets are turned so that normals run
// against the gradient, component by component. The move says what happens to Del S: it is gone
// when this returns.
SurfaceMesh build_tri_mesh(RestrictedDelaunay&& restricted, const SiteChain& chain,
                           const std::vector<double>& poles);

}  // namespace deliso
