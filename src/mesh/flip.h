// SPDX-License-Identifier: MIT
// Edge flips in the plain mesh: the two facets at an edge replaced by the two across the other
// diagonal of their quadrilateral. A flip keeps I1..I5 of tri_mesh.h when it is allowed.
#pragma once

#include <array>

#include "mesh/tri_mesh.h"

namespace deliso {

// The quadrilateral round the edge of facet f opposite its corner i: a = that corner, edge from b
// to c as f runs along it, d = the corner of the facet beyond.
struct Quad {
  FaceId f, g;
  VertexId a, b, c, d;
};

// pre: f has a neighbour there.
Quad quad_at(const TriMesh& mesh, FaceId f, int i);

// Whether a and d are joined already; then the flip would make an edge of four facets.
bool has_diagonal(const TriMesh& mesh, const Quad& quad);

// Puts (a, b, d) in f's place and (d, c, a) in g's. Their surface points are the caller's to set.
// pre: !has_diagonal(quad).
void flip_edge(TriMesh& mesh, const Quad& quad);

}  // namespace deliso
