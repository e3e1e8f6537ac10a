// SPDX-License-Identifier: MIT
// Makes T end on a block's inner faces as the plain T does: at crossings of grid edges alone, which
// the neighboring block has, too. Where T is made of cells it also ends at crossings of their
// edges, which the neighbor does not know.
//
// Between two crossings of grid edges, cells make a polyline in the face, on one side of the
// segment that joins the two: the curve there is a branch of a hyperbola. The polyline is moved
// into the block by so little that nothing comes between, and triangles close the gap to the
// segment. Two branches in one pixel bend away from each other, so nothing crosses.
#pragma once

#include "contour/contour.h"
#include "volume/volume.h"

namespace deliso {

// pre: T is embedded. The vertices that are moved are off Sigma by kPerturbationVoxels.
void make_seams_plain(ContourMesh& contour, const Volume& block);

}  // namespace deliso
