// SPDX-License-Identifier: MIT
// BuildTriMesh (paper §3.2): the facets of Stage 1 as a plain mesh.
#pragma once

#include <vector>

#include "delaunay/triangulation.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Returns the mesh of `facets`, whose corners are site numbers, as as_mesh_triangle() gives them.
// Its vertices are the sites with facets, in order of first use.
SurfaceMesh build_tri_mesh(const Triangulation& triangulation, std::vector<Triangle> facets,
                           std::vector<Dual> duals, const SiteChain& chain);

}  // namespace deliso
