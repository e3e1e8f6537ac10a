// SPDX-License-Identifier: MIT
// Makes the walls of a skin facets of a mesh of cells that has its vertices: of the Delaunay
// triangulation of a mesh of this program 94 to 100 % of them are from the start.
//
// A wall's edge that is missing crosses facets or edges of cells. Those are removed (moves.h) from
// its ends on; where none can be, the edge is cut where it crosses, and what it crossed goes. A
// wall whose edges are there is followed from its border inwards, facet by facet (follow_wall.h).
// An edge of cells that is in the way is removed, or cut where it crosses the wall. In exact
// arithmetic this ends (docs/guide/solids.md).
//
// Cuts lie on the edge or wall but for rounding. The result is embedded in any case, since walls
// are facets of cells that are positively oriented.
#pragma once

#include <vector>

#include "more/solids/cell_mesh.h"

namespace deliso {

// Marks the walls of the mesh. `walls` become those that it has, as parts of the given ones.
// What is cut depends on the order in which edges are taken; `turn` chooses another one.
RecoveryCounts recover(CellMesh& mesh, std::vector<Wall>& walls, int turn = 0);
inline constexpr int kRecoveryTurns = 4;

}  // namespace deliso
