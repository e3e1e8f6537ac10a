// SPDX-License-Identifier: MIT
// --cap: closes the surface on the box of the volume, to the boundary of the solid {f >= kappa}.
//
// The mesh touches the box along its boundary alone (S3 of surface/surface_mesh.h). Boundary
// edges of an embedded mesh never cross. Where those of another mesh do, the solid stays open.
#pragma once

#include <array>

#include "surface/given.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Returns which corners of the box are inside. Corner m is at the high end of axis k if bit k of m
// is set. pre: the volume has a voxel.
std::array<bool, 8> corners_inside(const Volume& volume, double kappa);

// Appends the caps to s.mesh. If there is no surface but the volume is inside, they are the whole
// box. The refinement's bound on r/l also bounds theirs, as far as boundary edges allow. Sets
// report.cap: if the surface cannot be closed, it stays open, and report.cap.failure gives the
// reason. Crossing triangles are not searched for: find_place_faults() does that, on the points
// as written. For faces without boundary edges, `inside` gives the corners of the box. pre: the
// mesh is linked.
void close_on_box(SurfaceMesh& s, const std::array<bool, 8>& inside, const Given& given);

}  // namespace deliso
