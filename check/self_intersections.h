// SPDX-License-Identifier: MIT
// Finds all pairs of triangles of a mesh that meet outside the vertex or edge that they share
// (embedding/triangle_pair.h). Costs O(n log n), whatever the mesh. A tree gives the candidates:
// triangles whose boxes meet.
//
// The work is bounded: where more boxes overlap than in any sound mesh, the search gives up and
// reports it.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "check/faults.h"
#include "check/triangle_tree.h"
#include "check/validity.h"
#include "mesh/tri_mesh.h"

namespace deliso {

struct Crossings {
  std::vector<std::pair<FaceId, FaceId>> pairs;  // (f, g) with f < g, ascending
  // Triangles around which some pairs were not tested, because there were too many; ascending.
  std::vector<FaceId> given_up;
};

// Bounds on the work of a leaf of the tree, which is four neighboring triangles: boxes compared,
// pairs tested, and pairs found. Sound meshes need a few hundred, about forty, and none.
inline constexpr std::size_t kMaxBoxesPerLeaf = 1u << 13, kMaxTestsPerLeaf = 512,
                             kMaxFoundPerLeaf = 64;
// Leaves that need more share this work. If they are few, as around the large triangles of a cap,
// all their pairs are tested. So are all pairs of a small mesh.
inline constexpr std::size_t kBoxesShared = 1u << 26, kTestsShared = 1u << 23,
                             kFoundShared = 1u << 19;

// Returns all crossings; ignores degenerate triangles. The result is the same for any number of
// threads.
// pre: the tree is that of these triangles; different ids have different positions.
Crossings find_crossings(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                         const TriangleTree& tree, int threads = 1);

// Reports the crossings of a mesh as faults. Returns the pairs by their ids in the mesh.
std::vector<std::pair<FaceId, FaceId>> report_self_intersections(const TriMesh& mesh,
                                                                 const CleanMesh& clean,
                                                                 int threads, Faults& faults);

}  // namespace deliso
