// SPDX-License-Identifier: MIT
// Clears a mesh off the box except along its boundary. Caps need it of a mesh that ends on the box.
// Caps lie in the faces of the box. An embedded mesh does not meet them if it touches each face
// along its boundary alone:
//   B1  Only boundary vertices lie on a face.
//   B2  Only boundary edges have both ends on one face.
//   B3  No facet has all corners on one face.
// Stage 2 requires none of these. Each violation is mended by one replacement of a disk
// (refine/refinement.h). So the mesh stays embedded: no new crossings.
#pragma once

#include <cstddef>

#include "surface/given.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Makes B1 to B3 hold. Returns at how many places every attempt was refused: those stay as they
// are. New vertices lie on Sigma if possible.
std::size_t lift_off(SurfaceMesh& s, const Given& given);

}  // namespace deliso
