// SPDX-License-Identifier: MIT
// --cap: closes the surface on the box of the volume, to the boundary of the solid {f >= kappa}.
//
// The mesh is made to touch the box along its boundary alone (cap/leave_box.h). Boundary edges that
// cross, which those of an embedded mesh never do, are split on their curve until they do not. That
// ends: within a pixel the arcs are branches of one hyperbola, on different sides of its
// asymptotes.
#pragma once

#include <array>

#include "isosurface/isosurface.h"
#include "surface/boundary.h"
#include "surface/parameters.h"
#include "surface/report.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Which corners of the box are inside: corner m is at the high end of axis k where bit k of m is
// set. pre: the volume has a voxel.
std::array<bool, 8> corners_inside(const Volume& volume, double kappa);

// Appends the caps to s.mesh; where there is no surface, but the volume is inside, they are the
// whole box. The r/l that the refinement is bounded by bounds theirs where boundary edges allow.
// Sets report.cap: what could not be closed stays open, and report.cap.failure says why. Triangles
// that cross are not looked for: count_crossings() does that, of the points as they are written.
// `inside` says of corners of the box what the mesh does not: where a face has no boundary edge.
// pre: the mesh is linked.
void close_on_box(SurfaceMesh& s, const Isosurface& surface, const BoundaryCurves& curves,
                  const std::array<bool, 8>& inside, const Parameters& parameters, Report& report);

}  // namespace deliso
