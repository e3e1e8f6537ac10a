// SPDX-License-Identifier: MIT
// Stage 2, Refine of paper Figure 4 and RefineGeom of Figure 9. It refines the mesh of Stage 1
// until every facet meets the criteria, the worst facet first.
//
// For a facet that violates a criterion it splits a side that is off its curve on the box, or
// collapses a short edge, or inserts the surface point, or inserts another point of Sigma near it.
// In between it flips edges that are not Delaunay. Then it removes vertices near a change that the
// criteria do not need (refine/thin.h), and inserts reference samples that are too far from the
// mesh. Then it makes facets Delaunay and moves corners, and last it keeps facets apart
// (refine/separate.h). Facets that stay bad are counted.
//
// Each operation replaces one disk (refine/refinement.h). So the mesh stays a manifold of the same
// topology, embedded, with its vertices on Sigma.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "refine/refinement.h"
#include "surface/given.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Refines `mesh` in place. `samples`: the reference samples. Throws InputError at max_vertices.
void refine(SurfaceMesh& mesh, std::span<const Vec3> samples, const Given& given);

// The part of a mesh that is refined; by default all of it.
struct RefineScope {
  FreeBox free_box;                   // the frozen facets, and the box of the others
  std::vector<std::uint8_t> is_done;  // per facet; those after the last are not done
  // Vertices near a change are removed where the criteria do not need them (refine/thin.h).
  bool thins = false;
};

// Refines that part. Dead facets stay. Returns per facet whether it is done. A facet for which a
// frozen one refused an operation is not.
std::vector<std::uint8_t> refine_part(SurfaceMesh& mesh, std::span<const Vec3> samples,
                                      const Given& given, RefineScope scope);

}  // namespace deliso
