// SPDX-License-Identifier: MIT
// BuildTriMesh (paper §3.2): Del S|Sigma as a mesh of its own.
#pragma once

#include <vector>

#include "recover/restricted.h"
#include "surface/surface_mesh.h"

namespace deliso {

// `poles` are per vertex of the triangulation, or none. Facets are turned so that normals run
// against the gradient, component by component. source: the vertex of the triangulation that each
// vertex was. The move says what happens to Del S: it is gone when this returns.
SurfaceMesh build_tri_mesh(RestrictedDelaunay&& restricted, const BoundaryChain& chain,
                           const std::vector<double>& poles, std::vector<VertexId>& source);

}  // namespace deliso
