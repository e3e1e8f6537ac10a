// SPDX-License-Identifier: MIT
// Which way round facets are that come from a triangulation, where nothing says so.
#pragma once

#include "isosurface/isosurface.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Turns the facets of every component the same way round, by a walk over its adjacency, and the
// whole of it so that most of its area has normals against the gradient: next to a crease of the
// surface a single facet's gradient can mislead.
void orient(SurfaceMesh& mesh, const Isosurface& surface);

}  // namespace deliso
