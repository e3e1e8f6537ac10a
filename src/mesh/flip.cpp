// SPDX-License-Identifier: MIT
#include "mesh/flip.h"

#include "base/check.h"

namespace deliso {
namespace {

void replace_neighbor(TriMesh& mesh, FaceId face, FaceId from, FaceId to) {
  if (face == kNoId) return;
  for (FaceId& n : mesh.faces[face].n) {
    if (n == from) n = to;
  }
}

// Walks from facet `start` round v, one way, until it is back or at the boundary; whether it has
// met `other`. `met_boundary` tells the caller to go the other way too.
bool walk_meets(const TriMesh& mesh, VertexId v, FaceId start, int turn, VertexId other,
                bool& met_boundary) {
  FaceId f = start;
  do {
    const Face& face = mesh.faces[f];
    const int i = corner_index(face, v);
    if (face.v[(i + 1) % 3] == other || face.v[(i + 2) % 3] == other) return true;
    f = face.n[(i + turn) % 3];
    if (f == kNoId) {
      met_boundary = true;
      return false;
    }
  } while (f != start);
  return false;
}

}  // namespace

Quad quad_at(const TriMesh& mesh, FaceId f, int i) {
  const Face& face = mesh.faces[f];
  const FaceId g = face.n[i];
  DELISO_ASSERT(g != kNoId);
  const VertexId b = face.v[(i + 1) % 3], c = face.v[(i + 2) % 3];
  VertexId d = kNoId;
  for (const VertexId v : mesh.faces[g].v) {
    if (v != b && v != c) d = v;
  }
  return {f, g, face.v[i], b, c, d};
}

bool has_diagonal(const TriMesh& mesh, const Quad& q) {
  bool met_boundary = false;
  if (walk_meets(mesh, q.a, q.f, 1, q.d, met_boundary)) return true;
  return met_boundary && walk_meets(mesh, q.a, q.f, 2, q.d, met_boundary);
}

void flip_edge(TriMesh& mesh, const Quad& q) {
  const Face f = mesh.faces[q.f], g = mesh.faces[q.g];
  const FaceId across_ab = f.n[corner_index(f, q.c)], across_ca = f.n[corner_index(f, q.b)];
  const FaceId across_bd = g.n[corner_index(g, q.c)], across_dc = g.n[corner_index(g, q.b)];
  mesh.faces[q.f] = {{q.a, q.b, q.d}, {across_bd, q.g, across_ab}};
  mesh.faces[q.g] = {{q.d, q.c, q.a}, {across_ca, q.f, across_dc}};
  replace_neighbor(mesh, across_bd, q.g, q.f);
  replace_neighbor(mesh, across_ca, q.f, q.g);
}

}  // namespace deliso
