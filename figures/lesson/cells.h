// SPDX-License-Identifier: MIT
// Voronoi cells, each with the piece of a surface in it: the topological ball property and three
// ways in which a cell breaks it. For the page of the lesson and its drawing on paper.
#pragma once

#include <vector>

#include "base/vec3.h"

namespace deliso::lesson {

using Polygon = std::vector<Vec3>;

struct Cell {
  const char *title, *text;
  std::vector<Polygon> sides;  // of the cell, counter-clockwise from outside
  std::vector<Polygon>
      surface;  // the piece: triangles of T cut by the cell, the outside of T in front
  std::vector<Polygon> ends;  // the edges in which the piece ends, a pair of points each
  Vec3 site{};                // set in torus_cells()
};

// A disk, a ring, two pieces, a disk and a ball. All of each lies in the ball around the origin of
// radius 1.
std::vector<Cell> example_cells();

// The forty cells of a torus, in place, without titles.
std::vector<Cell> torus_cells();

}  // namespace deliso::lesson
