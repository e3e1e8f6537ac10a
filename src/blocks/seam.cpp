// SPDX-License-Identifier: MIT
#include "blocks/seam.h"

#include <cmath>

#include "base/check.h"
#include "base/text.h"

namespace deliso {
std::optional<GridEdge> grid_edge_at(const Vec3& p, const Volume& volume) {
  GridEdge edge;
  int off_planes = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double spacing = volume.spacing()[axis], u = p[axis] / spacing;
    const int nearest = static_cast<int>(std::lround(u));
    std::int32_t& low = edge.low[static_cast<std::size_t>(axis)];
    low = nearest;
    if (nearest * spacing == p[axis]) continue;
    ++off_planes;
    edge.axis = axis;
    low -= p[axis] < nearest * spacing;
  }
  if (off_planes != 1) return std::nullopt;
  return edge;
}

void refuse_seam(const std::string& what) {
  throw InputError("the surface is too fine for a seam: " + what +
                   " cannot be taken out of it (another --seed may do, or other blocks)");
}

std::vector<SeamVertex> seam_of(const TriMesh& mesh, const Volume& volume) {
  std::vector<SeamVertex> seam;
  if (volume.inner_faces() == 0) return seam;
  const Box3 box = volume.box();
  std::vector<unsigned> faces;
  faces.reserve(mesh.points.size());
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    faces.push_back(box_faces_at(mesh.points[v], box) & volume.inner_faces());
    if (faces.back() == 0) continue;
    const auto edge = grid_edge_at(mesh.points[v], volume);
    if (!edge) {
      const Vec3 &p = mesh.points[v], s = volume.spacing();
      refuse_seam(text("the point (", p.x / s.x, " ", p.y / s.y, " ", p.z / s.z, ")"));
    }
    seam.push_back({v, *edge});
  }
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Face& face = mesh.faces[f];
    for (int i = 0; i < 3; ++i) {
      const VertexId a = face.v[(i + 1) % 3], b = face.v[(i + 2) % 3];
      const unsigned common = faces[a] & faces[b];
      if (common == 0) continue;
      if (face.n[i] != kNoId || (common & faces[face.v[i]]) != 0) {
        refuse_seam(text("facet ", f));
      }
    }
  }
  return seam;
}

}  // namespace deliso
