// SPDX-License-Identifier: MIT
// Makes T end on a block's inner faces as the plain T does: at crossings of grid edges alone, which
// the neighboring block has, too. Where T is made of cells it also ends at crossings of their
// edges, which the neighbor does not know.
//
// Between two crossings of grid edges, cells make a polyline in the face, on one side of the
// segment that joins the two: the curve there is a branch of a hyperbola. The polyline is lifted,
// which is to say moved into the block, and triangles close the gap to the segment. Two branches in
// one pixel bend away from each other, so nothing crosses there. But where samples are next to
// kappa, T may be nearer to the face than the lifted vertices. So all triangles of the voxel are
// tested by exact predicates, and its vertices are lifted less while some cross.
#pragma once

#include "contour/contour.h"
#include "volume/volume.h"

namespace deliso {

// The vertices that are moved are off Sigma by kPerturbationVoxels at most. Where triangles cross
// at the least lift too, their voxel joins `crossed_voxels`.
void make_seams_plain(ContourMesh& contour, const Volume& block);

}  // namespace deliso
