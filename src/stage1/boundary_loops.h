// SPDX-License-Identifier: MIT
// The boundary curves of T.
#pragma once

#include "contour/contour.h"
#include "surface/boundary.h"

namespace deliso {

// Returns the curves in which T ends on the box, without fixed arcs.
BoundaryLoops boundary_loops(const ContourMesh& contour);

}  // namespace deliso
