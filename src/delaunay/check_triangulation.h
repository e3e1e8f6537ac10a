// SPDX-License-Identifier: MIT
// Slow, independent checks of a triangulation against the invariants of triangulation.h. Each
// returns the first broken rule as a sentence that names its number, ids and coordinates, or the
// empty string.
#pragma once

#include <string>

#include "delaunay/triangulation.h"

namespace deliso {

// I1, I2, I4, and what follows from them for the whole: no facet in three cells, Euler's relation
// (vertices - edges + facets - cells = 0 with the infinite vertex). O(cells log cells).
std::string check_triangulation(const Triangulation& t);

// I3 by brute force: every cell against every vertex. O(cells * vertices).
std::string check_delaunay(const Triangulation& t);

}  // namespace deliso
