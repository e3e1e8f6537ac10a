// SPDX-License-Identifier: MIT
// The triangles at a vertex and on three corners, from the corners alone. Counting sorts, linear
// except for vertices of huge degree, which cost n log n.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/tri_mesh.h"

namespace deliso {

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
