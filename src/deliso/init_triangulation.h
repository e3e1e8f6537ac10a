// SPDX-License-Identifier: MIT
// InitTriangulation of paper Figure 4: the first sample S_0 and its Delaunay triangulation.
//
// Beside the paper's random points and boundary curves (§3, §5) every component of Sigma gets seeds
// of its own from the exact contour, and every block of 8^3 voxels it visits one: random rays miss
// small components and thin branches, and no later test can see what no point knows of.
#pragma once

#include "contour/contour.h"
#include "delaunay/triangulation.h"
#include "deliso/boundary.h"
#include "deliso/options.h"
#include "deliso/report.h"
#include "isosurface/isosurface.h"

namespace deliso {

struct InitialSample {
  Triangulation triangulation;
  BoundaryChain chain;
};

InitialSample init_triangulation(const Isosurface& surface, const ContourMesh& contour,
                                 const BoundaryCurves& curves, const Options& options, double r_min,
                                 Report& report);

}  // namespace deliso
