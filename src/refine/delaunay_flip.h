// SPDX-License-Identifier: MIT
// When an edge of the plain mesh should be flipped: the Delaunay test of Stage 2, by surface balls.
#pragma once

#include <array>
#include <optional>

#include "surface/surface_point.h"
#include "mesh/flip.h"

namespace deliso {

// The surface points of (a, b, d) and (d, c, a), when these should take the place of the two facets
// of the quadrilateral: one of those has the other's corner in its surface ball, the new ones have
// surface points and no such corner, the sum of the balls' radii falls, and the new edge is no
// sharper than 60 degrees or than the old one. That sum is what ends flipping: in the plane
// Delaunay flips lower it (Musin 1997), on a surface they need not and would go round in circles.
std::optional<std::array<Vec3, 2>> delaunay_flip(const TriMesh& mesh, const Quad& quad,
                                                 SurfacePointFinder& finder,
                                                 SearchCounters& counters);

}  // namespace deliso
