// SPDX-License-Identifier: MIT
// The ring of a vertex: its neighbors in order, and their places in the plane of its star. The
// facets of the star go when the vertex is removed; the ring is the boundary of the hole.
#pragma once

#include <array>
#include <cstdint>

#include "mesh/tri_mesh.h"

namespace deliso {

struct Ring {
  static constexpr int kMost = 16;  // vertices

  int size = 0;            // vertices
  int facets = 0;          // of the star: as many, or one less at the mesh's boundary
  bool is_closed = false;  // the vertex is not on the mesh's boundary
  // Facet k of the star lies between neighbors k and k + 1; outer[k] is the facet across from the
  // vertex.
  std::array<FaceId, kMost> star, outer;
  std::array<VertexId, kMost> vertex;
  std::array<Vec3, kMost> point;
  std::array<double, kMost> x, y;  // in the plane of the star, from the vertex
  Vec3 center;                     // the vertex
  Vec3 normal;                     // sum of the star's area normals
  double normal2 = 0;

  int after(int k) const { return k + 1 == size ? 0 : k + 1; }

  // Walks around v, a corner of `first`. False if it has too many neighbors, or some of its facets
  // are not in the mesh. `is_boundary`: v is on the mesh's boundary.
  bool walk(const TriMesh& mesh, FaceId first, VertexId v, bool is_boundary);
  // Sets x and y.
  void project();
};

}  // namespace deliso
