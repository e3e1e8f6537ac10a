// SPDX-License-Identifier: MIT
// T in an order that keeps what is near in space near in memory. Scan order puts a patch of T over
// as many places as it has slices; whoever works patch by patch waits for memory.
#pragma once

#include "contour/contour.h"

namespace deliso {

// Renumbers T's vertices block by block (of 8^3 voxels, x fastest), and sorts its triangles the
// same way; within a block the order stays. Of ContourMesh's invariants I6 no longer holds, and a
// chain no longer starts at its smallest vertex.
void order_by_blocks(ContourMesh& contour, const Volume& volume, int threads = 1);

}  // namespace deliso
