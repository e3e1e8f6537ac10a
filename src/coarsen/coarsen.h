// SPDX-License-Identifier: MIT
// Stage 1 of the exact program: coarsens the exact contour T, and T where blocks are joined, as far
// as the criteria allow (coarsen/coarsener.h). T is homeomorphic to Sigma, embedded, and its
// vertices lie on Sigma. The coarsened mesh is so, too (docs/proof.md, Theorem 3). No change of the
// coarsener asks whether facets cross: that is asked once, in the end (coarsen/embedding.h). Where
// it fails the mesh is coarsened again, and keeps its vertices near the faults.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/free_box.h"
#include "surface/given.h"
#include "surface/surface_mesh.h"

namespace deliso {

struct CoarsenScope {
  FreeBox free_box;             // the frozen facets, and the box in which vertices move
  std::vector<VertexId> first;  // tried first; then those near a change
};

// Returns the bound on the distance: that of the criteria, or a tenth of a voxel if they have none.
double coarsening_bound(const Parameters& parameters);

// Coarsens the mesh in place. `distance`: the bound. Facets that change get their duals; if the
// mesh has no duals, all get theirs. Dead facets and vertices without facets stay. Returns per
// facet whether it changed.
std::vector<std::uint8_t> coarsen(SurfaceMesh& s, const Given& given, double distance,
                                  const CoarsenScope& scope);

// The same for all of a mesh, by coarsening_bound(), and without what is dead.
void coarsen(SurfaceMesh& s, const Given& given);

}  // namespace deliso
