// SPDX-License-Identifier: MIT
// The regions of samples on one side of kappa that edges of the grid connect. A component of Sigma
// lies between regions of both sides.
#pragma once

#include <cstdint>

#include "base/disjoint_sets.h"
#include "volume/volume.h"

namespace deliso {

inline std::uint32_t number_of(const Volume& volume, Index3 p) {
  return static_cast<std::uint32_t>(volume.index(p.i, p.j, p.k));
}
inline bool is_inside(const Volume& volume, Index3 p, double kappa) {
  return volume.sample(p.i, p.j, p.k) >= kappa;
}

// Returns the regions as sets of the samples' numbers. pre: less than 2^32 samples.
inline DisjointSets regions_of_samples(const Volume& volume, double kappa) {
  DisjointSets regions(volume.sample_count());
  for_each_place({}, volume.voxels(), [&](Index3 p) {
    for (int axis = 0; axis < 3; ++axis) {
      Index3 q = p;
      if (--q[axis] >= 0 && is_inside(volume, p, kappa) == is_inside(volume, q, kappa)) {
        regions.unite(number_of(volume, q), number_of(volume, p));
      }
    }
  });
  return regions;
}

}  // namespace deliso
