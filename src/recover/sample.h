// SPDX-License-Identifier: MIT
// InitTriangulation of paper Figure 4: the first sample S_0 and its Delaunay triangulation.
//
// Beside the paper's random points and boundary curves (§3, §5) every component of Sigma gets seeds
// of its own from the exact contour, and every block of 8^3 voxels it visits one: random rays miss
// small components and thin branches, and no later test can see what no point knows of.
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

BoundaryCurves boundary_curves(const Isosurface& surface, const ContourMesh& contour,
                               const Parameters& parameters);

struct InitialSample {
  Triangulation triangulation;
  BoundaryChain chain;
  // Per vertex, the component of the contour it was seeded from; kNoId for random points.
  std::vector<std::uint32_t> contour_component;
};

// A first sample of vertices of T for the certified way: the coarse boundary chain, a few at
// random, one per (component, block). contour_vertex[s] is the vertex of T at site s.
struct InitialSites {
  Triangulation triangulation;
  BoundaryChain chain;
  std::vector<VertexId> contour_vertex;
};
InitialSites init_sites(const ContourMesh& contour, const BoundaryCurves& curves,
                        const Volume& volume, const Parameters& parameters, Report& report);

// Which components min_component leaves in.
std::vector<std::uint8_t> kept_components(const ContourMesh& contour, const Parameters& parameters);

InitialSample init_triangulation(const Isosurface& surface, const ContourMesh& contour,
                                 const BoundaryCurves& curves, const Parameters& parameters,
                                 Report& report);

}  // namespace deliso
