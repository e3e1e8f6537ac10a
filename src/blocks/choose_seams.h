// SPDX-License-Identifier: MIT
// The choice of seam vertices among the points of a block's boundary curves. The neighboring block
// must choose the same. So the choice depends only on the samples of the rectangle between four
// planes of the grid. The candidates are crossings of grid edges, in an order that does not depend
// on the loop's direction or start.
//
// Every second crossing is chosen. Refine mends what lies at a seam (blocks/seams.h), so a seam
// needs no more. Then chords that come near another one, of any curve in the rectangle, are halved
// until none do. That terminates, since the curves through all crossings never meet.
#pragma once

#include <vector>

#include "blocks/grid.h"
#include "surface/boundary.h"

namespace deliso {

// Marks the arcs on the block's inner faces as fixed, and the points of seams as kept. `block`: a
// block of a volume that `grid` cuts; it may be several boxes of the grid.
void choose_seams(const Volume& block, const BlockGrid& grid, BoundaryLoops& loops);

}  // namespace deliso
