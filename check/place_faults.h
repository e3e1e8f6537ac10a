// SPDX-License-Identifier: MIT
// Faults of a mesh that depend on where exactly its vertices are, so that rounding can make them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/tri_mesh.h"

namespace deliso {

struct PlaceFaults {
  // Pairs of triangles that cross, vertices at one position counted as one. A triangle around which
  // some pairs were not tested counts as one more.
  std::size_t crossings = 0;
  std::size_t flat = 0;        // triangles without area
  std::size_t coincident = 0;  // vertices at the position of one with a smaller id

  std::size_t count() const { return crossings + flat + coincident; }
  // Returns how many more there are than in `others`, of each kind.
  PlaceFaults beyond(const PlaceFaults& others) const;
};

// Counts the faults. `where`, if given, receives the vertices that have a part in one, ascending.
PlaceFaults find_place_faults(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                              int threads = 1, std::vector<VertexId>* where = nullptr);

}  // namespace deliso
