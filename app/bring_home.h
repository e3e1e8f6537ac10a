// SPDX-License-Identifier: MIT
// A mesh lies in the world, where its file has it; a volume is asked in its scaled frame.
#pragma once

#include "base/frame.h"
#include "mesh/tri_mesh.h"

namespace deliso {

// Whether every coordinate is a float, so that rounding to one may have been.
bool is_single_precision(const TriMesh& mesh);

// Takes the mesh from the world to the volume's scaled frame, in place, and tells how far a vertex
// may have been moved by rounding: to float where all coordinates are floats, else to double.
// Coordinates too small for the predicates become 0.
double bring_home(TriMesh& mesh, const Frame& at);

}  // namespace deliso
