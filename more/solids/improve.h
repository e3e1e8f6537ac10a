// SPDX-License-Identifier: MIT
// Makes the cells of a solid better shaped: vertices inside are moved, edges and facets removed,
// edges merged and split. The skin stays as it is. A change is taken only if the least shape
// (quality.h) of the cells concerned grows, so no cell is ever turned inside out (Freitag and
// Ollivier-Gooch 1997; Klingner and Shewchuk 2007).
#pragma once

#include <cstddef>

#include "more/solids/cell_mesh.h"

namespace deliso {

// pre: vertices below `first_inner` are on walls or of no cell.
void improve(CellMesh& mesh, VertexId first_inner, int passes);

}  // namespace deliso
