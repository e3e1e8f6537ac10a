// SPDX-License-Identifier: MIT
// How far many points are from the nearest triangle of a mesh.
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

// Per point the distance, infinite where there are no triangles, negative where it was given up.
// The same with any number of threads.
std::vector<double> nearest_distances(std::span<const Vec3> points, const TriangleTree& tree,
                                      int threads);

}  // namespace deliso
