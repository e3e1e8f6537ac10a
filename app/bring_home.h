// SPDX-License-Identifier: MIT
// Maps a mesh from the world, where its file has it, to the scaled frame of a volume.
#pragma once

#include "base/frame.h"
#include "mesh/tri_mesh.h"

namespace deliso {

// True if every coordinate is a float, or its shortest text in decimal digits, so that the mesh may
// have been rounded to floats.
bool is_single_precision(const TriMesh& mesh);

// Maps the mesh to the volume's scaled frame, in place. If both name a patient's space, it is out
// of its own. Returns the largest distance that rounding may have moved a vertex: to float if all
// coordinates are floats, else to double. Coordinates too small for the predicates become 0.
double bring_home(TriMesh& mesh, const Frame& volume);

}  // namespace deliso
