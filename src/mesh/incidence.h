// SPDX-License-Identifier: MIT
// The triangles at an edge and at a vertex, from the corners alone: for checks, which trust no
// stored neighbor and share no code with link_faces. Counting sorts, linear except for vertices of
// huge degree, which cost n log n.
#pragma once

#include <algorithm>
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

// Returns the uses of the edges whose first use is at begin to end - 1: so runs of all uses become
// runs of whole edges.
inline std::span<const EdgeUse> edges_within(std::span<const EdgeUse> uses, std::size_t begin,
                                             std::size_t end) {
  const auto first_of_edge = [&](std::size_t n) {
    while (n > 0 && n < uses.size() && is_same_edge(uses[n - 1], uses[n])) ++n;
    return n;
  };
  begin = first_of_edge(begin);
  return uses.subspan(begin, first_of_edge(end) - begin);
}

// Calls visit(span of uses) once per edge until it returns false.
template <class Visit>
void for_each_edge(std::span<const EdgeUse> uses, Visit visit) {
  for (std::size_t i = 0, j; i < uses.size(); i = j) {
    for (j = i + 1; j < uses.size() && is_same_edge(uses[i], uses[j]);) ++j;
    if (!visit(uses.subspan(i, j - i))) return;
  }
}

// The triangles at every vertex, ascending; a triangle that names it twice is there twice.
class TrianglesAtVertices {
 public:
  // pre: corners are below `vertices`.
  TrianglesAtVertices(std::size_t vertices, std::span<const Triangle> triangles);
  std::span<const std::uint32_t> at(VertexId v) const {
    return std::span(triangles_).subspan(begin_[v], begin_[v + 1] - begin_[v]);
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> triangles_;
};

// Triangles sorted by their ascending corners. Those on the same three are adjacent, in the order
// of their numbers.
class TrianglesByCorners {
 public:
  struct Entry {
    Triangle corners;  // ascending
    std::uint32_t triangle;
  };
  // pre: corners are below `vertices`.
  TrianglesByCorners(std::size_t vertices, std::span<const Triangle> triangles);
  std::span<const Entry> all() const { return entries_; }
  // Returns the number of the first triangle on these ascending corners; kNoId if there is none.
  std::uint32_t find(const Triangle& corners) const;

 private:
  std::vector<std::size_t> begin_;  // of the entries with this smallest corner
  std::vector<Entry> entries_;
};

}  // namespace deliso
