// SPDX-License-Identifier: MIT
// Welds the meshes of blocks into one. Blocks that meet have the same vertices on their seam, to
// the last bit, and nothing else of either lies in the face between them (J1 and J2 of
// docs/proof-more.md, Theorem 7). So vertices at one place are one vertex, and every edge of a seam
// has one facet on either side. The boundary curves of blocks continue each other, and are joined
// into loops of the whole: on the box, and along seams to blocks that are not there.
#pragma once

#include <functional>
#include <vector>

#include "blocks/block.h"

namespace deliso {

// True if the cell (blocks/grid.h) with this voxel is in another part, so that seams to it stay.
// Null: no cell is.
using IsElsewhere = std::function<bool(Index3 voxel)>;

// Returns the blocks as one. Empties them. Their order is that of the result's vertices and facets.
// pre: there is a block; the work at seams is marked.
Block weld(std::vector<Block>& blocks, const Grid& shape, const IsElsewhere& is_elsewhere);

}  // namespace deliso
