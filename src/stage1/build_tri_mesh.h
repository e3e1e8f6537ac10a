// SPDX-License-Identifier: MIT
// BuildTriMesh (paper §3.2): what Stage 1 has found as a mesh of its own.
#pragma once

#include <vector>

#include "delaunay/triangulation.h"
#include "surface/surface_mesh.h"

namespace deliso {

// `facets` name sites by their numbers, as as_mesh_triangle() gives them; vertices are the sites
// that have facets, in the order of these. `poles`: per site, or none.
SurfaceMesh build_tri_mesh(const Triangulation& triangulation, std::vector<Triangle> facets,
                           std::vector<Dual> duals, const SiteChain& chain,
                           const std::vector<double>& poles);

}  // namespace deliso
