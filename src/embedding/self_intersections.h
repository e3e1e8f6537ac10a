// SPDX-License-Identifier: MIT
// All pairs of triangles of a mesh that meet beyond what they share (embedding/triangle_pair.h):
// O(n log n), whatever the mesh. Candidates are triangles whose boxes meet, found through a tree.
// Triangles around one vertex, whose boxes all meet there, meet elsewhere exactly where the arcs do
// in which that vertex sees them: where there are many, the candidates are pairs of these. What is
// left is bounded: where more boxes overlap than a mesh has reason for, looking ends and says so.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "embedding/triangle_tree.h"
#include "mesh/tri_mesh.h"

namespace deliso {

struct Crossings {
  std::vector<std::pair<FaceId, FaceId>> pairs;  // (f, g) with f < g, ascending
  // Triangles around which some pairs were not looked at, since there were too many; ascending.
  std::vector<FaceId> given_up;
};

// The bounds on work, of four triangles next to each other (a leaf of the tree) together: boxes
// compared, pairs tested, and pairs found. Sound meshes need some hundred, some forty and none.
inline constexpr std::size_t kMostBoxes = 1u << 13, kMostTests = 512, kMostFound = 64;
// Leaves that need more share so many: where they are few, as around the large triangles of a cap,
// all is looked at, and so is all of a small mesh, whatever it is.
inline constexpr std::size_t kBoxesShared = 1u << 26, kTestsShared = 1u << 22,
                             kFoundShared = 1u << 19;
// Of triangles at a vertex, beyond which their arcs are looked at.
inline constexpr std::size_t kManyAround = 64;

// Degenerate triangles are passed over. The same with any number of threads.
// pre: the tree is that of these triangles; different ids have different positions.
Crossings find_crossings(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                         const TriangleTree& tree, int threads = 1);

// How many such pairs a mesh of these facets has over `points`; vertices at one position count as
// one, and facets without area or that twice name one are passed over. A facet around which not all
// could be looked at counts as one more.
std::size_t count_crossings(std::span<const Vec3> points, std::span<const Face> faces,
                            int threads = 1);

}  // namespace deliso
