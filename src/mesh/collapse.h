// SPDX-License-Identifier: MIT
// Edge collapses in the plain mesh: one end of an edge is merged into the other, and the facets at
// the edge go. A collapse keeps I1..I5 of tri_mesh.h, the Euler number and the boundary loops when
// the links of the two ends meet in the link of the edge alone (Dey, Edelsbrunner, Guha and
// Nekhayev 1999).
//
// Facets that are gone stay in place, dead, until remove_dead().
#pragma once

#include <span>
#include <vector>

#include "mesh/tri_mesh.h"

namespace deliso {

inline bool is_dead(const Face& face) {
  return face.v[0] == kNoId;
}

// The facets at the corner v of facet f, walking from there over neighbours; f comes first.
void facets_around(const TriMesh& mesh, FaceId f, VertexId v, std::vector<FaceId>& star);

// A directed edge to be collapsed: `from` goes, `to` stays. `star` are the facets at `from`.
struct Collapse {
  VertexId from, to;
  std::vector<FaceId> star;
};

// For the edge of f opposite its corner i, away from that end of it which is `from`. `allowed` says
// whether the links permit it; a boundary vertex only goes along a boundary edge.
bool plan_collapse(const TriMesh& mesh, FaceId f, int i, VertexId from, Collapse& plan);

// Facets of the star that hold both ends die, the others get `to` for `from`. Surface points are
// the caller's to set.
void collapse_edge(TriMesh& mesh, const Collapse& plan);

// Takes dead facets and the vertices that no facet uses out. new_id: of every vertex; kNoId: gone.
void remove_dead(TriMesh& mesh, std::vector<VertexId>& new_id);

}  // namespace deliso
