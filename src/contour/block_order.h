// SPDX-License-Identifier: MIT
// Reorders T so that neighbors in space are close in memory. Scan order spreads a patch of T over
// as many places as it has slices, so work on a patch waits for memory.
#pragma once

#include "contour/contour.h"

namespace deliso {

// Renumbers T's vertices block by block (of 8^3 voxels, x fastest) and sorts its triangles the same
// way. Within a block the order stays. Afterwards I6 of ContourMesh no longer holds, and a chain no
// longer starts at its smallest vertex.
void order_by_blocks(ContourMesh& contour, const Volume& volume, int threads = 1);

}  // namespace deliso
