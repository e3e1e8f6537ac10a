// SPDX-License-Identifier: MIT
// The exact program: a Delaunay mesh of the isosurface, made in two stages, block by block
// (blocks/mesh_in_blocks.h). Stage 1 coarsens the exact contour (coarsen/coarsen.h); Stage 2 is the
// paper's, under gates (refine/refine.h). The published program is paper/deliso.h.
#pragma once

#include <span>
#include <vector>

#include "deliso/options.h"
#include "mesh/tri_mesh.h"
#include "surface/given.h"
#include "surface/surface_mesh.h"
#include "volume/volume.h"

namespace deliso {

struct ContourMesh;

// Returns the mesh of {g = kappa} in the scaled frame, with the frame of the volume. Facets are
// counter-clockwise seen from g < kappa. The mesh is empty if no voxel holds the isovalue. With
// options.cap the caps follow the surface, from report.cap.surface_triangles on; they may be a
// whole box. Throws InputError for a volume without a voxel, beyond the limits of options.h and
// beyond --max-vertices. pre: all samples are finite (value_range() was called).
TriMesh mesh_isosurface(const Volume& volume, double kappa, const Options& options, Report& report);

// The same without a report. Throws InputError for a NaN or infinite sample, too.
TriMesh mesh_isosurface(const Volume& volume, double kappa, const Options& options = {});

struct DelaunayMesh {
  SurfaceMesh mesh;
  BoundaryCurves curves;      // of its chain
  std::vector<Vec3> samples;  // reference samples, the vertices of T
};

// Runs both stages on a whole volume, in this thread, and chooses the components before. `contour`:
// T of build_contour(), with at least one vertex.
DelaunayMesh delaunay_mesh(const Isosurface& surface, ContourMesh contour, const Options& options,
                           const Parameters& parameters, Report& report);

// Makes T embedded (contour/fine_contour.h), and its seams plain (contour/plain_seams.h).
void make_fine(ContourMesh& contour, const Isosurface& surface, const Parameters& parameters,
               Report& report);

// Runs both stages on one block, in this thread. `contour`: its T of make_fine(), with at least one
// vertex; its triangles are released. given.curves: T's boundary. `samples`: the reference samples
// of Refine, vertices of T.
SurfaceMesh delaunay_mesh(ContourMesh& contour, std::span<const Vec3> samples,
                          const Options& options, const Given& given);

}  // namespace deliso
