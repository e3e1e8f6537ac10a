// SPDX-License-Identifier: MIT
// The other direction of the distance: no point of Sigma far from the mesh. Facets near Sigma say
// nothing of a finger that no facet enters; points of Sigma that lie densely, the samples, do.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "embedding/box_grid.h"
#include "mesh/tri_mesh.h"

namespace deliso {

// A sample too far from the mesh, and the facet nearest to it.
struct FarSample {
  std::uint32_t sample;
  FaceId facet;
  double distance2;
};

// Leaves those samples in `numbers` that are further than `limit` from all facets, and returns
// them, the furthest first; of several nearest to one facet only the furthest.
std::vector<FarSample> find_far(const TriMesh& mesh, const BoxGrid& grid,
                                std::span<const Vec3> samples, double limit,
                                std::vector<std::uint32_t>& numbers);

}  // namespace deliso
