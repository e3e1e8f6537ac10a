// SPDX-License-Identifier: MIT
// Stage 1, certified: sites are vertices of the exact contour T, added until the labels of T
// satisfy the closed-ball conditions (certificate.h); then the dual K of the labels is homeomorphic
// to T, and so to Sigma, component by component. No Voronoi edge is searched for that.
//
// Two practical tests have the same remedy: no vertex of T may be too far from the facets at its
// site (protrusions.h), and no two facets of K may cross. At worst every vertex of T is a site and
// K is T, which is embedded.
//
// Sites are asked in rounds, in threads, and added in one: the same with any number of threads.
#pragma once

#include "contour/contour.h"
#include "surface/recovered.h"

namespace deliso {

// `plain`: build_contour(), with at least one vertex.
Recovered recover_certified(const Isosurface& surface, ContourMesh&& plain,
                            const Parameters& parameters, Report& report);

}  // namespace deliso
