// SPDX-License-Identifier: MIT
// Stage 2, Refine of paper Figure 4 and RefineGeom of Figure 9: the mesh that Stage 1 hands over is
// refined until every facet meets the criteria, worst first; first each region by itself
// (refine/regions.h), then what is left.
//
// For a facet that does not meet them: its short edge is collapsed; or its surface point is
// inserted; or another point of Sigma near it. When nothing is left to insert, samples of Sigma
// that are too far from the mesh are inserted, then facets are made Delaunay, and corners moved.
// What none of that mends is left and counted. Each operation is one replacement of a disk
// (refine/refinement.h), so the mesh stays a manifold of the same topology, embedded, with its
// vertices on Sigma.
#pragma once

#include <cstddef>
#include <span>

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
            std::span<const Vec3> samples, const Parameters& parameters, Report& report,
            std::size_t largest_region = 3000);

}  // namespace deliso
