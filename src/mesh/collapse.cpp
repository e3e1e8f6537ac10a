// SPDX-License-Identifier: MIT
#include "mesh/collapse.h"

#include <algorithm>

#include "base/sorted_list.h"

namespace deliso {
namespace {

int corner_of(const Face& face, VertexId v) {
  return face.v[0] == v ? 0 : face.v[1] == v ? 1 : 2;
}

bool has_corner(const Face& face, VertexId v) {
  return face.v[0] == v || face.v[1] == v || face.v[2] == v;
}

// Whether a side of the star's facets at v has no facet beyond: v is a boundary vertex.
bool at_boundary(const TriMesh& mesh, std::span<const FaceId> star, VertexId v) {
  return std::any_of(star.begin(), star.end(), [&](FaceId f) {
    const Face& face = mesh.faces[f];
    const int i = corner_of(face, v);
    return face.n[(i + 1) % 3] == kNoId || face.n[(i + 2) % 3] == kNoId;
  });
}

std::vector<VertexId> neighbors_of(const TriMesh& mesh, std::span<const FaceId> star, VertexId v) {
  std::vector<VertexId> neighbors;
  for (const FaceId f : star) {
    for (const VertexId w : mesh.faces[f].v) {
      if (w != v) neighbors.push_back(w);
    }
  }
  sort_out(neighbors);
  return neighbors;
}

}  // namespace

void facets_around(const TriMesh& mesh, FaceId f, VertexId v, std::vector<FaceId>& star) {
  star.assign(1, f);
  for (std::size_t n = 0; n < star.size(); ++n) {
    const Face& face = mesh.faces[star[n]];
    const int i = corner_of(face, v);
    for (const FaceId g : {face.n[(i + 1) % 3], face.n[(i + 2) % 3]}) {
      if (g != kNoId && std::find(star.begin(), star.end(), g) == star.end()) star.push_back(g);
    }
  }
}

bool plan_collapse(const TriMesh& mesh, FaceId f, int i, VertexId from, Collapse& plan) {
  const Face& face = mesh.faces[f];
  const VertexId a = face.v[(i + 1) % 3], b = face.v[(i + 2) % 3];
  plan.from = from;
  plan.to = from == a ? b : a;
  facets_around(mesh, f, plan.from, plan.star);
  std::vector<FaceId> star_to;
  facets_around(mesh, f, plan.to, star_to);
  const bool on_boundary_edge = face.n[i] == kNoId;
  if (at_boundary(mesh, plan.star, plan.from) && !on_boundary_edge) return false;

  // Of vertices, the links share the corners opposite the edge; of edges, none.
  const std::vector<VertexId> near = neighbors_of(mesh, plan.star, plan.from),
                              far = neighbors_of(mesh, star_to, plan.to);
  std::vector<VertexId> common;
  std::set_intersection(near.begin(), near.end(), far.begin(), far.end(),
                        std::back_inserter(common));
  if (common.size() != (on_boundary_edge ? 1u : 2u)) return false;
  for (const FaceId g : plan.star) {
    const Face& at = mesh.faces[g];
    if (has_corner(at, plan.to)) {
      const int k = corner_of(at, plan.from), m = corner_of(at, plan.to);
      if (at.n[k] == kNoId && at.n[m] == kNoId) return false;
      continue;
    }
    // A facet that would be there twice: the two ends are the tips of a pillow.
    const int k = corner_of(at, plan.from);
    const VertexId p = at.v[(k + 1) % 3], q = at.v[(k + 2) % 3];
    for (const FaceId h : star_to) {
      if (has_corner(mesh.faces[h], p) && has_corner(mesh.faces[h], q)) return false;
    }
  }
  return true;
}

void collapse_edge(TriMesh& mesh, const Collapse& plan) {
  for (const FaceId f : plan.star) {
    Face& face = mesh.faces[f];
    if (!has_corner(face, plan.to)) continue;
    const FaceId g = face.n[corner_of(face, plan.from)], h = face.n[corner_of(face, plan.to)];
    if (g != kNoId) mesh.faces[g].n[neighbor_index(mesh.faces[g], f)] = h;
    if (h != kNoId) mesh.faces[h].n[neighbor_index(mesh.faces[h], f)] = g;
    face.v = {kNoId, kNoId, kNoId};
    face.n = {kNoId, kNoId, kNoId};
  }
  for (const FaceId f : plan.star) {
    Face& face = mesh.faces[f];
    if (!is_dead(face)) face.v[corner_of(face, plan.from)] = plan.to;
  }
}

void remove_dead(TriMesh& mesh, std::vector<VertexId>& new_id) {
  new_id.assign(mesh.points.size(), kNoId);
  for (const Face& face : mesh.faces) {
    if (is_dead(face)) continue;
    for (const VertexId v : face.v) new_id[v] = 0;
  }
  VertexId vertices = 0;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (new_id[v] == kNoId) continue;
    mesh.points[vertices] = mesh.points[v];
    new_id[v] = vertices++;
  }
  mesh.points.resize(vertices);
  FaceId faces = 0;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    if (is_dead(mesh.faces[f])) continue;
    Triangle v = mesh.faces[f].v;
    for (VertexId& w : v) w = new_id[w];
    mesh.faces[faces] = {v, {kNoId, kNoId, kNoId}};
    if (!mesh.surface_points.empty()) mesh.surface_points[faces] = mesh.surface_points[f];
    ++faces;
  }
  mesh.faces.resize(faces);
  if (!mesh.surface_points.empty()) mesh.surface_points.resize(faces);
  link_faces(mesh);
}

}  // namespace deliso
