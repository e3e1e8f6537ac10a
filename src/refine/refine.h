// SPDX-License-Identifier: MIT
// Stage 2, Refine of paper Figure 4 and RefineGeom of Figure 9: the mesh that Stage 1 hands over is
// refined until every facet meets the criteria, by a queue, worst first: one for each part of the
// mesh (refine/parts.h), then one for what is left.
//
// For a facet that does not, what is tried, rung by rung: its short edge collapsed; its surface
// point inserted; another point of Sigma near it; a boundary edge split; an edge flipped; and where
// all of that is refused, the patch around it triangulated anew, a corner taken out, a corner
// moved. What none of them mends is left and counted. Each is one replacement of a disk of facets
// (refine/replace_disk.h), so the mesh stays a manifold of the same topology, embedded, with its
// vertices on Sigma.
#pragma once

#include <cstddef>
#include <span>

#include "surface/parameters.h"
#include "surface/report.h"
#include "surface/surface_mesh.h"

namespace deliso {

// A mesh of more facets is cut (refine/parts.h): the fewer a part has, the more lie at its edges.
inline constexpr std::size_t kLargestPart = 3000;

// Refines `mesh` in place, in parameters.threads threads. `witnesses`: points of Sigma that are to
// be no further from the mesh than the criteria say, as far as r_min allows. Throws InputError at
// max_vertices unless keep_partial.
void refine(SurfaceMesh& mesh, const Isosurface& surface, const BoundaryCurves& curves,
            std::span<const Vec3> witnesses, const Parameters& parameters, Report& report,
            std::size_t largest_part = kLargestPart);

}  // namespace deliso
