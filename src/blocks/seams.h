// SPDX-License-Identifier: MIT
// Stage 2 at the seams of a welded mesh: what was fixed there is refined like any other. First the
// vertices on a seam, and those beside one, are thinned. Then facets with a vertex on a seam are
// refined, and whatever changes by that.
//
// It is divided as blocks are. Around the faces between blocks lie boxes that share no point; in a
// second round boxes around the edges of the grid, in a third around its corners. Each round's
// boxes hold what the cuts of the round before left. A box is refined by itself, on its own
// samples. Its facets are those that lie in it. Other facets that reach into it are visible to the
// gates, and frozen. So facets of two boxes never meet, and the gates of refine/refinement.h hold.
// Boxes follow from the grid alone, so the result is the same with any number of threads.
#pragma once

#include "blocks/block.h"
#include "blocks/weld.h"

namespace deliso {

// Refines at the seams. Dead facets and unused vertices are removed. Adds what was done to
// `report`. Tells the observer, which may be null, of each box; stage "seams" begins whenever boxes
// are refined side by side.
void refine_seams(const BlockRun& run, WeldedMesh& whole, int threads, Observer* observer,
                  Report& report);

}  // namespace deliso
