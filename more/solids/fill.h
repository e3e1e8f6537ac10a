// SPDX-License-Identifier: MIT
// The inside of a skin that a mesh has as walls: which cells are in which region, and points in it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "more/solids/cell_mesh.h"
#include "more/solids/skin.h"

namespace deliso {

// Finds cells by walks, each from the last one found. Cells that are not Delaunay may lead a walk
// in a circle, so where it begins to look changes at each step.
class CellLocator {
 public:
  explicit CellLocator(const CellMesh& mesh) : mesh_(mesh) {}
  // Returns the cell that holds p; kNoId outside the mesh, or after too many steps.
  CellId cell_at(const Vec3& p);
  void begin_at(CellId c) { hint_ = c; }

 private:
  const CellMesh& mesh_;
  CellId hint_ = kNoId;
};

// Sets the regions of all cells: what lies on a side of a wall is said by the walls. Returns the
// first wall that disagrees with those before it, or with the outside of all; nullptr: there is
// none.
const Wall* set_regions(CellMesh& mesh, std::span<const Wall> walls);

// Inserts points by Bowyer's and Watson's way, with zones that end at walls and are cut down until
// each facet of them makes a cell of a shape over a floor. Those outside, or without such a zone,
// are left. Returns how many were inserted.
std::size_t insert_points(CellMesh& mesh, std::span<const Vec3> points);

}  // namespace deliso
