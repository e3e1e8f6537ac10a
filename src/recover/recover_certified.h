// SPDX-License-Identifier: MIT
// Stage 1, certified: sites are vertices of the exact contour T, added until the labels of T
// satisfy the closed-ball conditions (certificate.h); then the dual K of the labels is homeomorphic
// to T, and so to Sigma, component by component. No Voronoi edge is searched for that.
//
// Three practical tests have the same remedy: no vertex of T may be further than `fingers` from the
// facets at its site (a thin branch inside one Voronoi cell is a disk too), every facet of K above
// r_min must find the surface point that Stage 2 starts from, and no two facets of K may cross. At
// worst every vertex of T is a site and K is T, which is embedded.
//
// Sites are asked in rounds, in threads, and added in one: the same with any number of threads.
#pragma once

#include "contour/contour.h"
#include "recover/recovered.h"

namespace deliso {

// `plain`: build_contour(), with at least one vertex. Sites: some vertices of T at random, one per
// (component, block of 8^3 voxels), the coarse boundary chain; then grown as said above.
Recovered recover_certified(const Isosurface& surface, ContourMesh&& plain,
                            const Parameters& parameters, Report& report);

}  // namespace deliso
