// SPDX-License-Identifier: MIT
// Stage 1, certified. Sites are vertices of the exact contour T. They are added until the labels of
// T have the topological ball property (certificate.h). Then the dual K of the labels is
// homeomorphic to T, and so to Sigma, component by component. No Voronoi edge is searched for that.
//
// Three more tests have the same remedy. No vertex of T may be too far from the facets at its site
// (protrusions.h). No two facets of K may cross. No component may be reversed. At worst every
// vertex of T is a site; then K is T, which is embedded.
#pragma once

#include "contour/contour.h"
#include "stage1/first_sample.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Makes T fine enough for labels (contour/fine_contour.h).
void make_fine(ContourMesh& contour, const Isosurface& surface, const Parameters& parameters,
               Report& report);

// Adds sites to the first sample, as above, and returns the dual K. Releases the contour's
// triangles once it has their adjacency. Throws an InputError beyond --max-vertices. pre:
// make_fine() was called for `contour`, which has vertices.
SurfaceMesh recover(const Isosurface& surface, ContourMesh& contour, FirstSample first,
                    const Parameters& parameters, Report& report);

}  // namespace deliso
