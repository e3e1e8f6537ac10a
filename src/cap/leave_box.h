// SPDX-License-Identifier: MIT
// What caps ask of a mesh that ends on the box, and seams (blocks/seam.h) of one that ends on an
// inner face, which another mesh shares. Caps lie in its faces, so an embedded mesh does not
// meet them where it touches a face along its boundary alone:
//   B1  no vertex but those of the boundary lies on a face;
//   B2  no edge but those of the boundary has both ends on one face;
//   B3  no facet has all corners on one face.
// Stage 2 asks for none of it. Each place that lacks one is mended by one replacement of a disk
// (refine/refinement.h), so that the mesh stays embedded: nothing comes to cross.
#pragma once

#include <cstddef>

#include "isosurface/isosurface.h"
#include "surface/boundary.h"
#include "surface/parameters.h"
#include "surface/report.h"
#include "surface/surface_mesh.h"

namespace deliso {

inline constexpr unsigned kAllFaces = 0x3f;

// Makes B1 to B3 hold on some faces of the box (bit 2 * axis + (0 at the low end, 1 at the high
// end)), and returns at how many places every try was refused: those stay as they are. Vertices
// that come lie on Sigma where that is possible.
std::size_t leave_box(SurfaceMesh& s, const Isosurface& surface, const BoundaryCurves& curves,
                      unsigned faces, const Parameters& parameters, Report& report);

}  // namespace deliso
