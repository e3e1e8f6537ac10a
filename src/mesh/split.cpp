// SPDX-License-Identifier: MIT
#include "mesh/split.h"

namespace deliso {
namespace {

VertexId add_point(TriMesh& mesh, const Vec3& p) {
  mesh.points.push_back(p);
  return VertexId(mesh.points.size() - 1);
}

// Facet g, where there is one, has `now` for a neighbour where it had `was`.
void replace_neighbor(TriMesh& mesh, FaceId g, FaceId was, FaceId now) {
  if (g != kNoId) mesh.faces[g].n[neighbor_index(mesh.faces[g], was)] = now;
}

}  // namespace

VertexId split_edge(TriMesh& mesh, FaceId f, int i, const Vec3& p) {
  const VertexId m = add_point(mesh, p);
  const Face near = mesh.faces[f];
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  const VertexId a = near.v[i], b = near.v[j], c = near.v[k];
  const FaceId g = near.n[i], f1 = FaceId(mesh.faces.size());
  const FaceId g1 = g == kNoId ? FaceId(kNoId) : FaceId(f1 + 1);
  mesh.faces[f] = {{a, b, m}, {g, f1, near.n[k]}};
  mesh.faces.push_back({{a, m, c}, {g1, near.n[j], f}});
  replace_neighbor(mesh, near.n[j], f, f1);
  if (g == kNoId) return m;
  const Face far = mesh.faces[g];
  const int d = neighbor_index(far, f);  // corners d, c, b from there on
  const FaceId beyond_c = far.n[(d + 1) % 3], beyond_b = far.n[(d + 2) % 3];
  mesh.faces[g] = {{far.v[d], m, b}, {f, beyond_c, g1}};
  mesh.faces.push_back({{far.v[d], c, m}, {f1, g, beyond_b}});
  replace_neighbor(mesh, beyond_b, g, g1);
  return m;
}

VertexId split_face(TriMesh& mesh, FaceId f, const Vec3& p) {
  const VertexId m = add_point(mesh, p);
  const Face old = mesh.faces[f];
  const auto [a, b, c] = old.v;
  const FaceId f1 = FaceId(mesh.faces.size()), f2(f1 + 1);
  mesh.faces[f] = {{a, b, m}, {f1, f2, old.n[2]}};
  mesh.faces.push_back({{b, c, m}, {f2, f, old.n[0]}});
  mesh.faces.push_back({{c, a, m}, {f, f1, old.n[1]}});
  replace_neighbor(mesh, old.n[0], f, f1);
  replace_neighbor(mesh, old.n[1], f, f2);
  return m;
}

}  // namespace deliso
