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

#include <optional>
#include <stdexcept>

#include "more/solids/lattice.h"
#include "more/solids/solid.h"

namespace deliso {

struct SolidOptions {
  LatticeOptions lattice;
  bool fills = true;  // false: no points inside, and cells as they come
  int passes = 6;     // of improvement
};

// Throws SkinError where `skin` is no skin: walls cross, or regions do not follow each other.
struct SkinError : std::runtime_error {
  explicit SkinError(const char* what, std::optional<Vec3> place = {})
      : std::runtime_error(what), at(place) {}
  std::optional<Vec3> at;
};
Solid make_solid(const Skin& skin, const SolidOptions& options);

}  // namespace deliso
