// SPDX-License-Identifier: MIT
// InitTriangulation of paper Figure 4: the first sample S_0 and its Delaunay triangulation, the
// same for both ways of Stage 1. All points are vertices of the exact contour T.
//
// Beside the paper's random points and boundary curves (§3, §5) there is one of every component in
// each block of 8^3 voxels it visits: random points miss small components and thin branches, and no
// later test can see what no point knows of.
//
// Four auxiliary vertices far outside the box hold the triangulation together even where all of
// Sigma is one plane, and keep its hull away from the surface: no Voronoi edge or vertex that they
// have a part in comes near the box.
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
