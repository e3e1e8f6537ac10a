// SPDX-License-Identifier: MIT
#include "surface/surface_mesh.h"

#include <algorithm>

namespace deliso {
namespace {

// Removes the values whose new id is kNoId.
template <class T, class Id>
void remove_unnumbered(std::vector<T>& values, const std::vector<Id>& new_id) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (new_id[i] != kNoId) values[kept++] = values[i];
  }
  values.resize(kept);
  values.shrink_to_fit();
}

}  // namespace

FacetShape SurfaceMesh::shape(const Triangle& v, const Dual& dual) const {
  const auto& p = mesh.points;
  FacetShape shape = measure(p[v[0]], p[v[1]], p[v[2]], dual.center);
  if (!dual.on_surface) shape.h = shape.r;
  return shape;
}

bool SurfaceMesh::may_remove(VertexId v, const BoundaryCurves& curves) const {
  if (!chain.is_boundary(v)) return true;
  const VertexId before = chain.previous(v), next = chain.next(v);
  return !curves.is_kept(chain.place(v)) && chain.next(next) != before &&
         !curves.runs_beside_fixed({chain.place(before), mesh.points[before]},
                                   {chain.place(next), mesh.points[next]});
}

void SurfaceMesh::shrink_to_fit() {
  mesh.points.shrink_to_fit();
  mesh.faces.shrink_to_fit();
  duals.shrink_to_fit();
}

Dual dual_at(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x) {
  // The furthest corner: a rounded point is not equally far from the corners of a needle.
  return {x, std::max({distance2(x, a), distance2(x, b), distance2(x, c)}), true};
}

Dual dual_without_surface(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 center = circumcenter(a, b, c);
  return {center, distance2(center, a), false};
}

void facets_encroached(const SurfaceMesh& s, FaceId start, const Vec3& p,
                       std::vector<FaceId>& facets) {
  facets.assign(1, start);
  for (std::size_t next = 0; next < facets.size(); ++next) {
    for (const FaceId g : s.mesh.faces[facets[next]].n) {
      if (g == kNoId || !s.duals[g].holds(p)) continue;
      if (std::ranges::find(facets, g) == facets.end()) facets.push_back(g);
    }
  }
}

bool ends_on_chain(const SurfaceMesh& s) {
  std::size_t ends = 0, chain = 0;
  for (VertexId v = 0; v < s.mesh.points.size(); ++v) chain += s.chain.is_boundary(v);
  for (const Face& face : s.mesh.faces) {
    for (int i = 0; i < 3; ++i) {
      if (face.n[i] != kNoId) continue;
      if (!s.chain.is_edge(face.v[(i + 1) % 3], face.v[(i + 2) % 3])) return false;
      ++ends;
    }
  }
  return ends == chain;  // each vertex of the chain begins an edge
}

void remove_dead(SurfaceMesh& s) {
  TriMesh& mesh = s.mesh;
  std::vector<VertexId> new_id(mesh.points.size(), kNoId);
  std::vector<FaceId> new_face(mesh.faces.size(), kNoId);
  FaceId faces = 0;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    if (is_dead(mesh.faces[f])) continue;
    new_face[f] = faces++;
    for (const VertexId v : mesh.faces[f].v) new_id[v] = 0;
  }
  VertexId vertices = 0;
  for (VertexId& v : new_id) {
    if (v != kNoId) v = vertices++;
  }
  remove_unnumbered(mesh.points, new_id);
  remove_unnumbered(mesh.faces, new_face);
  remove_unnumbered(s.duals, new_face);
  s.chain = s.chain.renumbered(new_id);
  for (Face& face : mesh.faces) {
    for (VertexId& v : face.v) v = new_id[v];
    for (FaceId& g : face.n) {
      if (g != kNoId) g = new_face[g];
    }
  }
}

}  // namespace deliso
