// SPDX-License-Identifier: MIT
// The triangles of a mesh that are nearest to many points.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "embedding/triangle_tree.h"

namespace deliso {

// Leaves of the tree that are looked at for each run of 2^14 points. A mesh has some five near a
// point; where very many overlap, what is left of a run is given up.
inline constexpr std::size_t kMostLeavesOfRun = 1u << 20;

// A point for which looking ended has this squared distance.
inline constexpr double kGivenUp = -1;

// Per point the nearest triangle; none where there are no triangles. The same with any number of
// threads.
std::vector<NearestTriangle> nearest_triangles(std::span<const Vec3> points,
                                               const TriangleTree& tree, int threads);

}  // namespace deliso
