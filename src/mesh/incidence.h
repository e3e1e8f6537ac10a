// SPDX-License-Identifier: MIT
// The triangles at an edge, from the corners alone: for those who trust no stored neighbor. A
// counting sort, linear except for vertices of huge degree, which cost n log n.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/tri_mesh.h"

namespace deliso {

// Triangle `triangle` runs along the edge between lo < hi, from lo to hi when `forward`.
struct EdgeUse {
  VertexId lo, hi;
  FaceId triangle;
  std::uint8_t side;  // index of the corner opposite
  bool forward;
};

// Returns all sides of all triangles. Edges are in the order of (lo, hi); the uses of an edge are
// adjacent, in the order of the triangles. pre: corners are below `vertices`.
std::vector<EdgeUse> edge_uses(std::size_t vertices, std::span<const Triangle> triangles);

inline bool is_same_edge(const EdgeUse& a, const EdgeUse& b) {
  return a.lo == b.lo && a.hi == b.hi;
}

// Calls visit(span of uses) once per edge until it returns false.
template <class Visit>
void for_each_edge(std::span<const EdgeUse> uses, Visit visit) {
  for (std::size_t i = 0, j; i < uses.size(); i = j) {
    for (j = i + 1; j < uses.size() && is_same_edge(uses[i], uses[j]);) ++j;
    if (!visit(uses.subspan(i, j - i))) return;
  }
}

}  // namespace deliso
