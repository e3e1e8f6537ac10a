// SPDX-License-Identifier: MIT
// Stage 2, Refine of paper Figure 4 and RefineGeom of Figure 9. It refines the mesh of Stage 1
// until every facet meets the criteria, the worst facet first. Each region is refined by itself
// (refine/regions.h), then the whole mesh.
//
// For a facet that violates a criterion it collapses a short edge, or inserts the surface point, or
// inserts another point of Sigma near it. Then it inserts reference samples that are too far from
// the mesh. Last it makes facets Delaunay and moves corners. Facets that stay bad are counted. For
// a number of vertices or triangles it refines until there are more, and coarsens
// (refine/coarsen.h).
//
// Each operation replaces one disk (refine/refinement.h). So the mesh stays a manifold of the same
// topology, embedded, with its vertices on Sigma.
#pragma once

#include <cstddef>
#include <vector>

#include "surface/boundary.h"
#include "surface/parameters.h"
#include "surface/report.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Refines `mesh` in place, in parameters.threads threads. `samples`: the reference samples. A mesh
// of more than `largest_region` facets is cut; in a smaller region more facets are frozen. Throws
// InputError at max_vertices unless keep_partial; a desired number of vertices takes its place.
void refine(SurfaceMesh& mesh, const Isosurface& surface, const BoundaryCurves& curves,
            std::vector<Vec3> samples, const Parameters& parameters, Report& report,
            std::size_t largest_region = 3000);

}  // namespace deliso
