// SPDX-License-Identifier: MIT
// A solid of tetrahedra inside a closed surface, whose triangles it keeps.
//
//   skin ─→ Delaunay triangulation of its vertices ─→ its walls made facets   recover
//        ─→ the cells inside, and in which region                            fill
//        ─→ points of a lattice                                              lattice, fill
//        ─→ better shapes                                                    improve
//
// From the first step on every state is a mesh of positively oriented cells by exact signs, so
// nothing is to be repaired at the end.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <vector>

#include "more/solids/cell_mesh.h"
#include "more/solids/lattice.h"
#include "more/solids/recover.h"
#include "more/solids/skin.h"

namespace deliso {

struct SolidOptions {
  LatticeOptions lattice;
  bool fills = true;  // false: no points inside, and cells as they come
  int passes = 6;     // of improvement
};

struct Solid {
  IdArray<VertexId, Vec3> points;  // those of the skin, as given; cuts of it; points inside
  std::vector<Corners> cells;
  std::vector<RegionId> regions;   // of each cell
  std::vector<Wall> walls;         // the skin's, or the parts that replace one
  std::size_t skin_points = 0;     // the skin's, with cuts
  RecoveryCounts recovery;
};

// Throws SkinError where `skin` is no skin: walls cross, or regions do not follow each other.
class SkinError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};
Solid make_solid(const Skin& skin, const SolidOptions& options);

}  // namespace deliso
