// SPDX-License-Identifier: MIT
// Maps a mesh from the world, where its file has it, to the scaled frame of a volume. All that
// rounding did on the way is settled here, so that nothing after it needs a tolerance of its own: a
// volume that lies turned in the world has the same report as one along the axes.
#pragma once

#include "mesh/tri_mesh.h"
#include "volume/grid.h"

namespace deliso {

// How far the digits of coordinates may be from the numbers that were meant, by the numbers alone:
// a text of n digits, and floats, are recognized whatever file they were in.
struct DigitsOfPoints {
  bool is_single = false;  // every coordinate is a float, or the text of one
  double error = 0;        // the largest along an axis; 0: all digits of a double
};
DigitsOfPoints digits_of(const std::vector<Vec3>& points);

// Sets coordinates too small for the predicates to 0: they are far below all rounding.
void drop_smallest(std::vector<Vec3>& points);

// Maps the mesh to the volume's scaled frame, in place. If both name a patient's space, it is out
// of its own. `rounding`: as of MeshNotes. Returns the tolerance for vertices on Sigma and on the
// box, in the scaled frame: a millionth of a voxel and twice the error of the digits, or `stated`
// if that is larger.
//
// Vertices that rounding may have moved off the box come back to it:
//   H1  A vertex that is outside of the box by the tolerance at most is on the box.
//   H2  An end of the mesh (of a closed mesh any vertex) within the tolerance of a face is on it.
//       Where most of these are on the face but for the error of the digits, or of doubles, only
//       they are: then the others were made off it, however near.
double bring_home(TriMesh& mesh, const Grid& volume, double rounding = 0, double stated = 0);

}  // namespace deliso
