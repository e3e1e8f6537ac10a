// SPDX-License-Identifier: MIT
// DelIso(f, kappa) of paper Figure 4: a Delaunay mesh of the isosurface, in two stages.
#pragma once

#include <vector>

#include "deliso/options.h"
#include "mesh/tri_mesh.h"
#include "surface/boundary.h"
#include "surface/report.h"
#include "surface/surface_mesh.h"
#include "volume/volume.h"

namespace deliso {

struct ContourMesh;

// Returns the mesh of {g = kappa}, in the scaled frame, with the frame of the volume, facets
// counter-clockwise seen from g < kappa. Empty where no voxel holds the isovalue. With options.cap
// the caps follow the surface, from report.cap.surface_triangles on, and it may be a whole box of
// them. Throws InputError beyond the limits of options.h, and when --max-vertices is passed. pre:
// all samples are finite (value_range() has been asked).
TriMesh mesh_isosurface(const Volume& volume, double kappa, const Options& options, Report& report);

struct DelaunayMesh {
  SurfaceMesh mesh;
  BoundaryCurves curves;      // that its chain is on
  std::vector<Vec3> samples;  // dense on Sigma: the vertices of T; none once refine() was called
};

// Figure 4, without isovalues to settle, seams and caps: what mesh_isosurface() is
// made of. `contour`: T, of build_contour(), with at least one vertex.
DelaunayMesh delaunay_mesh(const Isosurface& surface, ContourMesh&& contour, const Options& options,
                           const Parameters& parameters, Report& report);

}  // namespace deliso
