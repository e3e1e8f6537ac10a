// SPDX-License-Identifier: MIT
#include "contour/plain_seams.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
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
  BoundaryChains& chains = contour.boundary;
  BoundaryChains plain;
  const double off = kPerturbationVoxels * block.voxel();
  for (std::size_t c = 0; c < chains.size(); ++c) {
    const std::size_t first = chains.first[c], n = chains.first[c + 1] - first;
    const auto vertex = [&](std::size_t k) { return chains.vertices[first + k % n]; };
    const auto goes = [&](std::size_t k) {
      return (inner & contour.box_faces[vertex(k)]) != 0 &&
             !is_on_grid_edge(contour.points[vertex(k)], block.spacing());
    };
    std::vector<std::size_t> lifted;
    for (std::size_t k = 0; k < n; ++k) {
      if (goes(k)) {
        lifted.push_back(k);
        continue;
      }
      plain.vertices.push_back(vertex(k));
      plain.face.push_back(chains.face[first + k]);
      plain.on_box_edge.push_back(chains.on_box_edge[first + k]);
      // The polyline from here runs along edges of triangles; these run along the other way.
      const ContourId from = vertex(k);
      for (std::size_t m = k + 1; goes(m); ++m) {
        contour.triangles.push_back({vertex(m + 1), vertex(m), from});
      }
    }
    for (const std::size_t k : lifted) {
      const ContourId v = vertex(k);
      contour.points[v] = contour.points[v] + off * inwards(contour.box_faces[v]);
      contour.box_faces[v] = 0;
    }
    plain.first.push_back(static_cast<std::uint32_t>(plain.vertices.size()));
    plain.component.push_back(chains.component[c]);
  }
  chains = std::move(plain);
}

}  // namespace deliso
