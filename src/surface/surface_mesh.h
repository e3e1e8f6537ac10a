// SPDX-License-Identifier: MIT
// What Stage 1 hands to Stage 2: a manifold with surface points, and nothing of the triangulation.
// Whatever produces one of these is a way through Recover.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/boundary.h"
#include "recover/restricted.h"
#include "mesh/tri_mesh.h"

namespace deliso {

struct Recovered {
  TriMesh mesh;                      // linked, oriented, with surface points
  std::vector<double> pole_heights;  // one per vertex
  BoundaryChain chain;               // over the mesh's vertices
  // One per facet, 1 where the dual line misses Sigma within the circumradius; the circumcenter
  // stands in for the surface point there.
  std::vector<std::uint8_t> unhit;
  std::vector<VertexId> source;  // the vertex of Stage 1 each one was; kNoId: of another origin
};

// BuildTriMesh (paper §3.2): Del S|Sigma as a mesh of its own; `poles` are per vertex of the
// triangulation. Facets are turned so that normals run against the gradient, component by
// component.
// The move says what happens to Del S: it is gone when this returns.
Recovered build_tri_mesh(RestrictedDelaunay&& restricted, const BoundaryChain& chain,
                         const std::vector<double>& poles);

}  // namespace deliso
