// SPDX-License-Identifier: MIT
// The nearest triangles of a mesh to many points.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "check/triangle_tree.h"

namespace deliso {

// Bound on the leaves of the tree visited for each task of 2^14 points. A mesh has about five near
// a point. If very many overlap, the rest of the task is given up.
inline constexpr std::size_t kMaxLeavesPerTask = 1u << 20;

// The squared distance of a point whose search was given up.
inline constexpr double kGivenUp = -1;

// Returns the nearest triangle of each point; kNoId if there are no triangles. The result is the
// same for any number of threads.
std::vector<NearestTriangle> nearest_triangles(std::span<const Vec3> points,
                                               const TriangleTree& tree, int threads);

}  // namespace deliso
