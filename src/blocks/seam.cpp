// SPDX-License-Identifier: MIT
#include "blocks/seam.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace deliso {

std::optional<GridEdge> grid_edge_at(const Vec3& p, const Volume& volume) {
  GridEdge edge;
  int off_planes = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double spacing = volume.spacing()[axis], u = p[axis] / spacing;
    const int nearest = static_cast<int>(std::lround(u));
    int& low = edge.low[axis];
    low = nearest;
    if (nearest * spacing == p[axis]) continue;
    ++off_planes;
    edge.axis = axis;
    low -= p[axis] < nearest * spacing;
  }
  if (off_planes != 1) return std::nullopt;
  return edge;
}

unsigned faulty_faces(const SurfaceMesh& s, const BoundaryCurves& curves, const Volume& block) {
  const Box3 box = block.box();
  const unsigned inner = block.inner_faces();
  std::vector<std::uint8_t> faces(s.mesh.points.size());
  unsigned faulty = 0;
  for (VertexId v = 0; v < s.mesh.points.size(); ++v) {
    faces[v] = static_cast<std::uint8_t>(box_faces_at(s.mesh.points[v], box) & inner);
    if (faces[v] == 0) continue;
    if (!s.chain.is_boundary(v) || !curves.is_kept(s.chain.place(v))) faulty |= faces[v];
  }
  for (const Face& face : s.mesh.faces) {
    for (int i = 0; i < 3; ++i) {
      const VertexId a = face.v[(i + 1) % 3], b = face.v[(i + 2) % 3];
      const unsigned common = faces[a] & faces[b];
      if (common == 0) continue;
      if (face.n[i] != kNoId || (common & faces[face.v[i]]) != 0) faulty |= common;
    }
  }
  return faulty;
}

}  // namespace deliso
