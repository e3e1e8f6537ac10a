// SPDX-License-Identifier: MIT
#include "surface/surface_mesh.h"

#include <limits>

namespace deliso {

double SurfaceMesh::pole(const Triangle& v) const {
  if (pole_heights.empty()) return std::numeric_limits<double>::infinity();
  return (pole_heights[v[0]] + pole_heights[v[1]] + pole_heights[v[2]]) / 3;
}

Dual dual_at(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x) {
  // The furthest corner: those of a needle are not equally far from a point that was rounded.
  return {x, std::max({distance2(x, a), distance2(x, b), distance2(x, c)}), true};
}

Dual dual_without_surface(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 center = circumcenter(a, b, c);
  return {center, distance2(center, a), false};
}

void remove_dead(SurfaceMesh& s) {
  TriMesh& mesh = s.mesh;
  std::vector<VertexId> new_id(mesh.points.size(), kNoId);
  for (const Face& face : mesh.faces) {
    if (is_dead(face)) continue;
    for (const VertexId v : face.v) new_id[v] = 0;
  }
  VertexId vertices = 0;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (new_id[v] == kNoId) continue;
    mesh.points[vertices] = mesh.points[v];
    if (!s.pole_heights.empty()) s.pole_heights[vertices] = s.pole_heights[v];
    new_id[v] = vertices++;
  }
  mesh.points.resize(vertices);
  if (!s.pole_heights.empty()) s.pole_heights.resize(vertices);
  s.chain = s.chain.renumbered(new_id);

  std::vector<FaceId> new_face(mesh.faces.size(), kNoId);
  FaceId faces = 0;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    if (is_dead(mesh.faces[f])) continue;
    new_face[f] = faces;
    mesh.faces[faces] = mesh.faces[f];
    s.duals[faces++] = s.duals[f];
  }
  mesh.faces.resize(faces);
  s.duals.resize(faces);
  for (Face& face : mesh.faces) {
    for (VertexId& v : face.v) v = new_id[v];
    for (FaceId& g : face.n) {
      if (g != kNoId) g = new_face[g];
    }
  }
}

}  // namespace deliso
