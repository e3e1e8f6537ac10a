// SPDX-License-Identifier: MIT
// A solid of tetrahedra: what make_solid returns, files hold, and check_solid looks at.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "more/solids/skin.h"

namespace deliso {

using Tetrahedron = std::array<VertexId, 4>;  // corners: det[b - a, c - a, d - a] > 0

struct RecoveryCounts {
  std::size_t missing_edges = 0, missing_walls = 0;  // at the beginning
  std::size_t cut_edges = 0, cut_walls = 0;
  std::size_t lost = 0;  // walls that are missing at the end
};

struct Solid {
  IdArray<VertexId, Vec3> points;  // those of the skin, as given; cuts of it; points inside
  std::vector<Tetrahedron> cells;
  std::vector<RegionId> regions;  // of each cell
  std::vector<Wall> walls;        // the skin's, or the parts that replace one
  std::size_t skin_points = 0;    // the skin's, with cuts
  RecoveryCounts recovery;
};

}  // namespace deliso
