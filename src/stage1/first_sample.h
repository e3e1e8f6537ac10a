// SPDX-License-Identifier: MIT
// InitTriangulation of paper Figure 4, certified: the first sample S_0 and its Delaunay
// triangulation. All points are vertices of the exact contour T.
//
// S_0 has the paper's random points and boundary curves (§3, §5). It also has a point of every
// component in each block of 8^3 voxels that the component meets. Random points miss small
// components and thin branches, and later tests cannot find a piece of Sigma without a point.
//
// It also has the auxiliary vertices of delaunay/triangulation.h.
#pragma once

#include "contour/contour.h"
#include "delaunay/triangulation.h"
#include "isosurface/isosurface.h"
#include "surface/boundary.h"
#include "surface/parameters.h"
#include "surface/report.h"

namespace deliso {

// Throws an InputError if the sites are more than --max-vertices.
void require_room(const Triangulation& triangulation, const Parameters& parameters);

struct FirstSample {
  Triangulation triangulation;
  SiteChain chain;  // coarse
};
// Returns the first sample. Writes its size to the report.
FirstSample init_triangulation(const ContourMesh& contour, const BoundaryCurves& curves,
                               const Volume& volume, const Parameters& parameters, Report& report);

}  // namespace deliso
