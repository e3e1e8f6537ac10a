// SPDX-License-Identifier: MIT
// Where a refined mesh is not yet what it should be: facets that Stage 2 had to leave bad, and
// facets that cross others. The cause is a contour too coarse for what Sigma does there (sheets and
// specks thinner than a voxel), so the answer is a set of voxels for it to be made finer in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "surface/criteria.h"
#include "surface/surface_mesh.h"
#include "volume/volume.h"

namespace deliso {

struct Trouble {
  std::vector<std::uint64_t> crossing_voxels;  // of the facets that cross others
  std::vector<std::uint64_t> voxels;           // voxel_number()s, ascending
  std::size_t bad_facets = 0;                  // above r_min, with r/l or h/r over its limit
  std::size_t crossing_pairs = 0;              // of facets, by exact predicates
  std::size_t facets_above_r_min = 0;
  std::size_t weight() const { return bad_facets + crossing_pairs; }
  // No crossing, and so few bad facets that creases of Sigma may well be all of their cause.
  bool is_slight() const { return crossing_pairs == 0 && 3000 * bad_facets <= facets_above_r_min; }
};

// How many facets above r_min break any criterion.
std::size_t count_unrefined(const Recovered& refined, const Criteria& criteria);

// Only r/l and h/r are looked at: the other criteria never want for vertices of T.
Trouble find_trouble(const Recovered& refined, const Criteria& criteria, const Volume& volume);

}  // namespace deliso
