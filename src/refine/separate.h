// SPDX-License-Identifier: MIT
// Keeps a mesh apart from itself. Where Sigma touches itself, or nearly, facets lie on each other
// but for rounding: no facets cross, and yet no tetrahedralizer can tell them apart. At the end of
// Stage 2 such places are mended, by replacements of disks as everything else:
//   - of two facets folded onto each other, the edge is flipped, the corner of one is merged into
//     that of the other, the edge is collapsed, or an end of it that is a tip is removed;
//   - an edge shorter than a thousandth of a voxel is collapsed, the longest edge of a needle is
//     flipped;
//   - facets that face each other, nearer than Parameters::gap, are moved apart along their
//     normals. Only then a vertex leaves Sigma, by about the gap.
#pragma once

#include <vector>

#include "refine/refinement.h"

namespace deliso {

// Mends such places at facets that are not frozen. `is_crowded`: per vertex, nonzero if it may be
// within the gap of a facet that it is no corner of. Returns the new facets, in the order of their
// ids.
std::vector<FaceId> separate(Refinement& r, const IdArray<VertexId, std::uint8_t>& is_crowded);

}  // namespace deliso
