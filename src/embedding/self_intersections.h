// SPDX-License-Identifier: MIT
// All pairs of triangles of a mesh that meet beyond what they share (embedding/triangle_pair.h),
// found through a tree of boxes: O(n log n) for a mesh whose triangles are about as large as they
// are apart.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "embedding/triangle_tree.h"
#include "mesh/tri_mesh.h"

namespace deliso {

// Pairs (f, g) with f < g, ascending. Degenerate triangles are passed over.
// pre: the tree is that of these triangles; different ids have different positions.
std::vector<std::pair<FaceId, FaceId>> self_intersections(const std::vector<Vec3>& points,
                                                          std::span<const Triangle> triangles,
                                                          const TriangleTree& tree);

// How many such pairs a mesh of these facets has over `points`; vertices at one position count as
// one, and facets without area or that twice name one are passed over.
std::size_t count_crossings(std::span<const Vec3> points, std::span<const Face> faces);

}  // namespace deliso
