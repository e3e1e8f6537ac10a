// SPDX-License-Identifier: MIT
// The other direction of the distance: no point of Sigma far from the mesh. Facets near Sigma say
// nothing of a finger that no facet enters; points of Sigma that lie densely, the witnesses, do.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/tri_mesh.h"
#include "surface/box_grid.h"

namespace deliso {

// A witness too far from the mesh, and the facet nearest to it.
struct FarPoint {
  std::uint32_t witness;
  FaceId facet;
  double distance2;
};

// Leaves those witnesses in `numbers` that are further than `limit` from all facets. Quick where
// one is near the witness before it.
void keep_far(const TriMesh& mesh, const BoxGrid& grid, std::span<const Vec3> witnesses,
              double limit, std::vector<std::uint32_t>& numbers);

// Those, the furthest first; of several nearest to one facet only the furthest.
std::vector<FarPoint> furthest(const TriMesh& mesh, const BoxGrid& grid,
                               std::span<const Vec3> witnesses, double limit,
                               std::span<const std::uint32_t> numbers);

}  // namespace deliso
