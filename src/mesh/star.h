// SPDX-License-Identifier: MIT
// The paper's Disk() test (§3.1) and its half-disk relaxation (§5), as pure combinatorics: the
// topology of the triangles around one vertex. It needs no coordinate,
// adjacency or orientation.
//
// The link of q has one edge per triangle: the triangle's side opposite q.
//   S1  Disk: the link is one simple cycle (of three or more edges, all different).
//   S2  Half disk: the link is one simple path (of one or more edges), q on the boundary.
//   S3  Neither: the link has two pieces, a vertex of three or more edges, or an edge twice, or a
//       triangle names a vertex twice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "mesh/tri_mesh.h"

namespace deliso {

enum class Star : std::uint8_t {
  empty,      // no triangle: q is not in the mesh
  disk,       // S1: the triangles close up around q
  half_disk,  // S2: the triangles fan out once, between two boundary edges at q
  singular,   // S3: q is not a manifold vertex
};

// Classifies the triangles around q. pre: each of them contains q.
Star classify_star(VertexId q, std::span<const Triangle> triangles);

// The connections of the triangles at a vertex, by the other vertices of their edges there.
struct VertexLink {
  std::size_t fans = 0;        // connected pieces
  std::size_t vertices = 0;    // around it
  std::size_t loose_ends = 0;  // vertices of only one triangle
  bool closed() const { return loose_ends == 0; }
};

// Returns the link of q, in O(n log n). pre: each triangle contains q, once.
VertexLink link_of(VertexId q, std::span<const Triangle> triangles);

}  // namespace deliso
