// SPDX-License-Identifier: MIT
// Stage 1, certified: sites are vertices of the exact contour T, added until the labels of T
// satisfy the closed-ball conditions (certificate.h); then the dual K of the labels is homeomorphic
// to T, and so to Sigma, component by component. No Voronoi edge is searched for that.
//
// Two practical tests follow, each with the same remedy: no vertex of T may be further than
// `fingers` from the facets at its site (a thin branch inside one Voronoi cell is a disk too), and
// every facet of K must find the surface point that Stage 2 starts from. In voxels that are split,
// because Stage 2 met trouble there, the second test is strict: the surface point lies near, and
// the surface at the corners faces as the facet does.
#pragma once

#include "contour/contour.h"
#include "surface/boundary.h"
#include "surface/options.h"
#include "surface/surface_mesh.h"
#include "surface/report.h"
#include "isosurface/isosurface.h"

namespace deliso {

// Sites: some vertices of T at random, one per (component, block of 8^3 voxels), the coarse
// boundary chain, and those `earlier_sites` that are vertices of T. Then grows them as said above
// and hands over K. `contour` is split as `split` says; vertices that coincide are moved apart.
Recovered recover_certified(const Isosurface& surface, ContourMesh& contour,
                            const BoundaryCurves& curves, const ContourSplit& split,
                            std::vector<Vec3> earlier_sites, const Options& options,
                            Report& report);

}  // namespace deliso
