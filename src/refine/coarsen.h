// SPDX-License-Identifier: MIT
// Coarsens a mesh to a number of vertices or triangles: removes vertices one by one, the one whose
// removal costs least first. A vertex is merged into a neighbor, so all vertices stay on Sigma.
// Each removal is an operation of Stage 2 and passes its tests G1 to G5, so the topology stays, and
// no two facets cross.
//
// The cost is the quadric error of Garland and Heckbert 1997: the squared distances from the
// planes of the facets that the vertex stands for, each times its facet's area.
#pragma once

#include <cstddef>
#include <limits>

#include "refine/refinement.h"

namespace deliso {

// Removes vertices until no more than `vertices` and `triangles` are left, or until no removal
// passes the tests. Returns how many vertices are left. A removal takes away two triangles, or one
// on the boundary, so one triangle less than asked for may be left. pre: every vertex has a facet.
std::size_t coarsen(Refinement& r, std::size_t vertices,
                    std::size_t triangles = std::numeric_limits<std::size_t>::max());

}  // namespace deliso
