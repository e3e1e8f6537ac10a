// SPDX-License-Identifier: MIT
// Stage 2, Refine of paper Figure 4 and RefineGeom of Figure 9. It refines the mesh that Stage 1
// hands over until every facet meets the criteria, the worst facet first: each region by itself
// (refine/regions.h), then the whole.
//
// Of a facet that misses a criterion it collapses a short edge, or inserts the surface point, or
// inserts another point of Sigma near by. When nothing is left to insert, it inserts reference
// samples that are too far from the mesh, then makes facets Delaunay and moves corners. Facets that
// none of this mends are left and counted. For a number of vertices it refines until there are
// more, and coarsens (refine/coarsen.h). Each operation replaces one disk (refine/refinement.h). So
// the mesh stays a manifold of the same topology, embedded, with its vertices on Sigma.
#pragma once

#include <cstddef>
#include <vector>

#include "surface/boundary.h"
#include "surface/parameters.h"
#include "surface/report.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Refines `mesh` in place, in parameters.threads threads. `samples`: points of Sigma that are to be
// no further from the mesh than the criteria say, as far as r_min allows. A mesh of more than
// `largest_region` facets is cut: the smaller a region, the more facets lie at its sides. Throws
// InputError at max_vertices unless keep_partial.
void refine(SurfaceMesh& mesh, const Isosurface& surface, const BoundaryCurves& curves,
            std::vector<Vec3> samples, const Parameters& parameters, Report& report,
            std::size_t largest_region = 3000);

}  // namespace deliso
