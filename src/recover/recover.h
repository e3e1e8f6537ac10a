// SPDX-License-Identifier: MIT
// Stage 1, certified. Sites are vertices of the exact contour T. They are added until the labels of
// T satisfy the closed-ball conditions (certificate.h). Then the dual K of the labels is
// homeomorphic to T, and so to Sigma, component by component. No Voronoi edge is searched for that.
//
// Two practical tests have the same remedy: no vertex of T may be too far from the facets at its
// site (protrusions.h), and no two facets of K may cross. At worst every vertex of T is a site and
// K is T, which is embedded.
//
// Sites are tested in rounds, in threads, and added in one thread. So the result is the same with
// any number of threads.
#pragma once

#include "contour/contour.h"
#include "stage1/first_sample.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Makes T fine enough for labels (contour/fine_contour.h), block by block.
void make_fine(ContourMesh& contour, const Isosurface& surface, const Parameters& parameters,
               Report& report);

// Grows the first sample, vertices of T at random and the coarse boundary chain, as said above, and
// returns the dual K. Lets go of the contour's triangles once it has their adjacency. pre:
// make_fine() was called for `contour`, with at least one vertex.
SurfaceMesh recover(const Isosurface& surface, ContourMesh& contour, FirstSample first,
                    const Parameters& parameters, Report& report);

}  // namespace deliso
