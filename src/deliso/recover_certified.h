// SPDX-License-Identifier: MIT
// Stage 1, certified: sites are vertices of the exact contour T, added until the labels of T
// satisfy the closed-ball conditions (certificate.h); then the dual K of the labels is homeomorphic
// to T, and so to Sigma, component by component. No Voronoi edge is searched for that.
//
// Two practical tests follow, each with the same remedy: no vertex of T may be further than
// `fingers` from the facets at its site (a thin branch inside one Voronoi cell is a disk too), and
// every facet of K must find the surface point that Stage 2 starts from. Where the vertices of T
// are too few for that, at sheets and specks thinner than a voxel, the voxels concerned are split,
// and the sites there chosen again from the finer T.
#pragma once

#include "contour/contour.h"
#include "deliso/options.h"
#include "deliso/recovered.h"
#include "deliso/report.h"
#include "isosurface/isosurface.h"

namespace deliso {

// Sites: some vertices of T at random, one per (component, block of 8^3 voxels), and the coarse
// boundary chain. Then grows them as said above and hands over K. `contour` is the plain contour,
// and afterwards the one that K is the dual on; the chain's places are places on its boundary.
Recovered recover_certified(const Isosurface& surface, ContourMesh& contour, const Options& options,
                            Report& report);

}  // namespace deliso
