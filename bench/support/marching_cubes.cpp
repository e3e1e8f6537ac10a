// SPDX-License-Identifier: MIT
#include "support/marching_cubes.h"

#include <span>
#include <utility>

#include "base/check.h"
#include "contour/contour_stream.h"
#include "contour/voxel_topology.h"

namespace deliso {
namespace {

using Loop = std::span<const std::uint8_t>;

// True if one face of the voxel has both edges.
bool in_one_face(int a, int b) {
  const auto [a0, a1] = corners_of_edge(a);
  const auto [b0, b1] = corners_of_edge(b);
  const int all_set = a0 & a1 & b0 & b1, any_set = a0 | a1 | b0 | b1;
  return all_set != 0 || any_set != 7;
}

// Cuts the piece of a loop from i to k, closed by a diagonal, into triangles. Tries the corners
// between them, in order, as the third corner at the diagonal. Returns false if none gives
// diagonals as in M2.
bool cut(Loop loop, std::size_t i, std::size_t k, std::vector<VoxelTriangle>& triangles) {
  if (k == i + 1) return true;
  const bool whole = i == 0 && k + 1 == loop.size();
  if (!whole && in_one_face(loop[i], loop[k])) return false;
  const std::size_t before = triangles.size();
  for (std::size_t j = i + 1; j < k; ++j) {
    triangles.push_back({loop[i], loop[j], loop[k]});
    if (cut(loop, i, j, triangles) && cut(loop, j, k, triangles)) return true;
    triangles.resize(before);
  }
  return false;
}

// Meshes each voxel by the table, which may differ from its exact loops. Crossings are the vertices
// of the mesh.
class TableSink final : public ContourSink {
 public:
  TableSink(const Volume& volume, std::vector<Vec3>& points, std::vector<Triangle>& triangles)
      : spacing_(volume.spacing()), points_(points), triangles_(triangles) {
    for (int mask = 0; mask < 256; ++mask) {
      cases_[static_cast<std::size_t>(mask)] = marching_cubes_case(mask);
    }
  }

  ContourId crossing(int axis, Index3 sample, double c0, double c1, std::uint8_t) override {
    if (points_.size() >= kNoId) throw InputError("the mesh has 2^32 vertices or more");
    Vec3 p{static_cast<double>(sample.i), static_cast<double>(sample.j),
           static_cast<double>(sample.k)};
    p[axis] += c0 / (c0 - c1);
    points_.push_back({p.x * spacing_.x, p.y * spacing_.y, p.z * spacing_.z});
    return ContourId(points_.size() - 1);
  }

  void voxel(const VoxelPieces& pieces) override {
    std::array<VertexId, 12> on_edge;
    for (std::size_t n = 0; n < pieces.loops.first[pieces.loops.count]; ++n) {
      on_edge[pieces.loops.edge[n]] = VertexId(pieces.vertex[n].number());
    }
    for (const auto& [a, b, c] : cases_[static_cast<std::size_t>(mask_of(pieces.corners))]) {
      triangles_.push_back({on_edge[a], on_edge[b], on_edge[c]});
    }
  }

 private:
  Vec3 spacing_;
  std::vector<Vec3>& points_;
  std::vector<Triangle>& triangles_;
  std::array<std::vector<VoxelTriangle>, 256> cases_;
};

}  // namespace

std::vector<VoxelTriangle> marching_cubes_case(int mask) {
  const VoxelLoops loops = trace_loops(mask, 0);
  std::vector<VoxelTriangle> triangles;
  for (int l = 0; l < loops.count; ++l) {
    const Loop loop = loops.edges(l);
    DELISO_CHECK(cut(loop, 0, loop.size() - 1, triangles));
  }
  return triangles;
}

TriMesh marching_cubes(const Volume& volume, double kappa) {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  TableSink sink(volume, points, triangles);
  walk_contour(volume, kappa, sink);
  TriMesh mesh = make_tri_mesh(std::move(points), triangles);
  mesh.frame = volume.frame();
  return mesh;
}

}  // namespace deliso
