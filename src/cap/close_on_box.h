// SPDX-License-Identifier: MIT
// --cap: closes the surface on the box of the volume, to the boundary of the solid {f >= kappa}.
//
// Caps are plane, so the mesh may touch a face of the box only along its boundary, and its boundary
// edges may not cross. Stage 2 asks for neither. Before the caps are made,
//   - interior vertices on the box are moved off it by a hair;
//   - interior edges between two boundary vertices of one face get a vertex on Sigma off the box,
//     and so do triangles that have no other edges than boundary edges on one face;
//   - boundary edges that cross are split on their curve until they do not. That ends: within a
//     pixel the arcs are branches of one hyperbola, on different sides of its asymptotes.
#pragma once

#include "isosurface/isosurface.h"
#include "mesh/tri_mesh.h"
#include "surface/boundary.h"
#include "surface/report.h"
#include "volume/volume.h"

namespace deliso {

// What a mesh of Delaunay triangles brings along; Marching Cubes needs none of it.
struct BoundaryAid {
  const Isosurface& surface;
  const BoundaryCurves& curves;
  BoundaryChain& chain;
};

// Appends the caps to the mesh; where there is no surface, but the volume is inside, they are the
// whole box. `lambda` bounds their r/l where boundary edges allow. Sets report.cap: what could not
// be closed stays open, and report.cap.failure says why.
// pre: the mesh is linked.
void close_on_box(TriMesh& mesh, const Volume& volume, double kappa, double lambda,
                  const BoundaryAid* aid, Report& report);

}  // namespace deliso
