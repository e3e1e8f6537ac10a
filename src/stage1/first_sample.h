// SPDX-License-Identifier: MIT
// InitTriangulation of paper Figure 4: the first sample S_0 and its Delaunay triangulation, the
// same for both ways of Stage 1. All points are vertices of the exact contour T.
//
// Beside the paper's random points and boundary curves (§3, §5) every component has a point in each
// block of 8^3 voxels that it visits. Random points miss small components and thin branches, and no
// later test can see a piece of Sigma without a point.
//
// Four auxiliary vertices lie far outside the box. With them there is a triangulation even where
// all of Sigma is one plane, and its hull is away from the surface: their Voronoi edges and
// vertices are far from the box.
#pragma once

#include "contour/contour.h"
#include "delaunay/triangulation.h"
#include "isosurface/isosurface.h"
#include "surface/boundary.h"
#include "surface/parameters.h"
#include "surface/report.h"

namespace deliso {

inline constexpr std::size_t kAuxiliaryVertices = 4;

// Whether a vertex at p is an auxiliary one.
bool is_auxiliary(const Vec3& p, const Box3& box);

// Throws an InputError when sites have come to be more than --max-vertices.
void require_room(const Triangulation& triangulation, const Parameters& parameters);

struct FirstSample {
  Triangulation triangulation;
  SiteChain chain;                 // the coarse one
  std::vector<std::uint8_t> kept;  // per component of T, whether it is to be meshed
};
FirstSample init_triangulation(const ContourMesh& contour, const BoundaryCurves& curves,
                               const Volume& volume, const Parameters& parameters, Report& report);

}  // namespace deliso
