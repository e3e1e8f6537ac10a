// SPDX-License-Identifier: MIT
// The paper's Disk() test (§3.1) and its half-disk relaxation (§5), as pure combinatorics: what do
// the triangles around one vertex form? Both stages ask; no coordinate, adjacency or orientation is
// looked at.
//
// The link of q has one edge per triangle: the triangle's side opposite q. So
//   S1  disk       the link is one simple cycle (of three or more edges, all different);
//   S2  half disk  the link is one simple path (of one or more edges), q on the boundary;
//   S3  a link with two pieces, a vertex of three or more edges, an edge twice, or a triangle
//       that names a vertex twice is neither.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "mesh/tri_mesh.h"

namespace deliso {

enum class Star : std::uint8_t {
  empty,      // no triangle: q is not on the surface's mesh
  disk,       // S1: the triangles close up around q
  half_disk,  // S2: the triangles fan out once, between two boundary edges at q
  singular,   // S3: q is no manifold vertex
};

const char* name_of(Star star);

// Classifies the triangles around q. pre: each of them contains q.
Star classify_star(VertexId q, std::span<const Triangle> triangles);

// How the triangles at a vertex hang together: by the other vertices of their edges there.
struct VertexLink {
  std::size_t fans = 0;        // connected pieces
  std::size_t vertices = 0;    // around it
  std::size_t loose_ends = 0;  // of these, those of one triangle only
  bool closed() const { return loose_ends == 0; }
};

// Disks and half disks of up to 64 triangles: n^2 comparisons, nothing allocated; others:
// O(n log n). pre: each triangle contains q, once.
VertexLink link_of(VertexId q, std::span<const Triangle> triangles);

}  // namespace deliso
