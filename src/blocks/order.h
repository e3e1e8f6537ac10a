// SPDX-License-Identifier: MIT
// The order of a mesh that was made in blocks. It follows from the places of the vertices, not from
// who refined which seam first, so one process and many end with the same bytes.
#pragma once

#include <cstddef>
#include <vector>

#include "blocks/block.h"
#include "blocks/grid.h"

namespace deliso {

// Returns the live facets in the order of their vertices. `vertices`: how many ids these have.
std::vector<FaceId> facet_order(const IdArray<FaceId, Face>& faces, std::size_t vertices);

// Removes dead facets and vertices without facets. Sorts the vertices by the cell of the grid that
// they lie in, then by place; turns each facet so that its first vertex comes first, and sorts the
// facets by their vertices. What is left to do at seams moves along.
void order_by_place(Block& block, const BlockGrid& grid, const Grid& shape, int threads);

}  // namespace deliso
