// SPDX-License-Identifier: MIT
// Both stages at the seams of a welded mesh, which has all vertices of T there. It is coarsened
// (coarsen/coarsen.h), beginning with vertices up to two edges from a seam. Then facets with a
// vertex on a seam are refined, and those that changed.
//
// It is divided as blocks are. Around the faces between blocks lie boxes that share no point; in a
// second round boxes around the edges of the grid, in a third around its corners. Each round's
// boxes hold what the cuts of the round before left. A box is refined by itself, on its own
// samples. Its facets are those that lie in it. Other facets that reach into it are visible to the
// tests, and frozen. So facets of two boxes never meet, and what the stages promise holds.
// Boxes follow from the grid alone, so the result is the same with any number of threads.
//
// Nothing in a box depends on ids: its facets and vertices are in the order of their places. Boxes
// that depend on each other share a point, so a process may refine those that lie in its blocks,
// and leave the others to the one that has all blocks. The mesh is the same.
#pragma once

#include <functional>
#include <span>

#include "blocks/block.h"

namespace deliso {

// True for a box that is to be refined, by the numbers of the cells (blocks/grid.h) it lies in.
using IsDue = std::function<bool(std::span<const std::size_t> cells)>;

// Samples beyond a box that are read too, for searches from facets in it.
inline constexpr int kSeamMarginSamples = 4;

// Coarsens and refines at the seams of welded blocks, in the boxes that are due. Dead facets and
// unused vertices stay. Adds what was done to whole.report. Tells the observer, which may be null,
// of each box; stage "seams" begins with each round.
void refine_seams(const BlockRun& run, Block& whole, const IsDue& is_due, Observer* observer);

}  // namespace deliso
