// SPDX-License-Identifier: MIT
// Places where a mesh is valid, but so nearly not that other programs fail there: triangles that
// are nearly lines, triangles folded on each other, and vertices that nearly touch a triangle.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "check/triangle_tree.h"
#include "check/vertex_grids.h"
#include "mesh/incidence.h"
#include "mesh/tri_mesh.h"
#include "volume/volume_source.h"

namespace deliso {

// Degrees. A triangle with a smaller angle is a needle; two triangles with a smaller angle between
// them are a fold.
inline constexpr double kLeastAngle = 0.01, kLeastFold = 1;

// Voxels (Volume::voxel()). A vertex nearer than that to a triangle of others is a near vertex.
inline constexpr double kNearVoxels = 6e-4;
// Returns that distance.
double near_distance(const Grid& volume);

// True if a triangle without corner v is within `distance` of v. Looks at a bounded number of them.
bool has_triangle_near(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                       const TriangleTree& tree, VertexId v, double distance);

struct ClosePlaces {
  std::vector<FaceId> needles;
  std::vector<std::pair<FaceId, FaceId>> folds;   // one per edge
  std::vector<std::pair<VertexId, FaceId>> near;  // one per vertex
  std::size_t given_up = 0;  // triangles left out: too many vertices are around them
};

// Finds these places. A fold that the surface has too is none: there both triangles face the side
// that the gradient of the field says. One place is found once: needles are in no fold, and corners
// of needles and folds are no near vertices. The result is the same for any number of threads.
// pre: the uses of edges and the grids are those of these triangles; none is degenerate.
ClosePlaces find_close_places(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                              std::span<const EdgeUse> uses, const VertexGrids& grids,
                              const VolumeSource& field, int threads = 1);

// Returns how many of the places of a solid have a part in its caps: a triangle that is one, or a
// vertex of caps alone. `is_cap`: per triangle.
std::size_t count_at_caps(const ClosePlaces& found, std::span<const Triangle> triangles,
                          const std::vector<bool>& is_cap);

}  // namespace deliso
