// SPDX-License-Identifier: MIT
#include "contour/plain_seams.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "embedding/triangle_pair.h"

namespace deliso {
namespace {

// True if p lies on an edge of the grid: at a sample's place along two axes or more.
bool is_on_grid_edge(const Vec3& p, const Vec3& spacing) {
  int on_planes = 0;
  for (int axis = 0; axis < 3; ++axis) {
    on_planes += std::round(p[axis] / spacing[axis]) * spacing[axis] == p[axis];
  }
  return on_planes >= 2;
}

}  // namespace

void make_seams_plain(ContourMesh& contour, const Volume& block) {
  const unsigned inner = block.inner_faces();
  if (inner == 0 || contour.split_voxels == 0) return;
  const double off = kPerturbationVoxels * block.voxel();
  for (std::size_t l = 0; l < contour.boundary.size(); ++l) {
    const BoundaryLoop loop = std::exchange(contour.boundary.loops[l], {});
    const std::vector<VertexId> all = std::exchange(contour.boundary.vertices[l], {});
    const auto vertex = [&](std::size_t k) { return all[k % all.size()]; };
    const auto goes = [&](std::size_t k) {
      return (inner & contour.box_faces[vertex(k)]) != 0 &&
             !is_on_grid_edge(contour.points[vertex(k)], block.spacing());
    };
    std::vector<VertexId> lifted;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const VertexId from = vertex(k);
      if (goes(k)) {
        lifted.push_back(from);
        continue;
      }
      contour.boundary.loops[l].push_back(loop[k]);
      contour.boundary.vertices[l].push_back(from);
      // The polyline from here runs along edges of triangles; these run along the other way.
      for (std::size_t m = k + 1; goes(m); ++m) {
        contour.triangles.push_back({vertex(m + 1), vertex(m), from});
      }
    }
    for (const VertexId v : lifted) {
      contour.points[v] = contour.points[v] + off * inwards(contour.box_faces[v]);
      contour.box_faces[v] = 0;
    }
  }
}

}  // namespace deliso
