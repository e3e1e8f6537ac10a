// SPDX-License-Identifier: MIT
// Coarsens sheets: fewer vertices, as far as the bound on the distance and the shapes of facets
// allow. Each change replaces half disks and disks of facets by others with the same boundary, as
// Stage 1 does (coarsen/coarsener.h):
//   - a vertex within a sheet is removed, and its hole filled by the largest angle;
//   - a vertex on a curve is removed, and in each sheet that ends there the half of its hole
//     filled: the curve goes straight on from the vertex before to the next;
//   - a vertex within a sheet moves to the middle of its star and on to the border, one on a curve
//     to where all its fields are equal;
//   - an edge within a sheet is flipped where the angles across it are too large.
// New edges and facets are not among the old ones, so the complex keeps its topology. That it does
// not cross itself, and that each region keeps its body, is asked once, in the end
// (more/bodies/sheet_faults.h); where it fails the sheets are coarsened again, and keep their
// vertices near the faults.
#pragma once

#include "more/bodies/sheets.h"
#include "run/parameters.h"
#include "run/report.h"

namespace deliso {

// What a part of the sheets may do.
struct SheetScope {
  const Partition& partition;
  const Parameters& parameters;
  double distance;  // the bound
  Box3 box;         // all change is in it
  // The faces of the box that others share: vertices there stay, none comes there, and no edge
  // comes to lie in one.
  unsigned inner_faces = 0;

  // True if a vertex may come to p.
  bool holds(const Vec3& p) const {
    return box.contains(p) && (box_faces_at(p, box) & inner_faces) == 0;
  }
};

// Coarsens the free facets in place. Vertices of other facets stay. Points keep their numbers, also
// those that lose all facets.
void coarsen_sheets(Sheets& sheets, const SheetScope& scope, Report& report);

}  // namespace deliso
