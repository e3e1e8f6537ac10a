// SPDX-License-Identifier: MIT
// Faults of a mesh that depend on where exactly its vertices are, so that rounding can make them.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "mesh/tri_mesh.h"

namespace deliso {

struct PlaceFaults {
  std::size_t crossings = 0;   // pairs of triangles; of count_crossings()
  std::size_t flat = 0;        // triangles without area
  std::size_t coincident = 0;  // vertices at the position of one with a smaller id

  bool any() const { return crossings + flat + coincident > 0; }
  // Returns how many more there are than in `others`, of each kind.
  PlaceFaults beyond(const PlaceFaults& others) const;
};

PlaceFaults count_place_faults(std::span<const Vec3> points, std::span<const Face> faces,
                               int threads);

// Returns what rounding made, "2 pairs of triangles cross, 1 triangle flat", of the kinds that
// there are.
std::string place_faults_text(const PlaceFaults& faults);

}  // namespace deliso
