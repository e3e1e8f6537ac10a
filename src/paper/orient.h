// SPDX-License-Identifier: MIT
// Orientation of facets of a triangulation, which have none.
#pragma once

#include "isosurface/isosurface.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Orients the facets of every component alike, by a walk over its adjacency. The component is then
// oriented so that most of its area has normals against the gradient. A single facet does not
// decide: next to a crease of the surface its gradient can mislead.
void orient(SurfaceMesh& mesh, const Isosurface& surface);

}  // namespace deliso
