// SPDX-License-Identifier: MIT
// The exact program: a Delaunay mesh of the isosurface, made in two stages, block by block
// (blocks/mesh_in_blocks.h). Stage 1 coarsens the exact contour (coarsen/coarsen.h); Stage 2 is the
// paper's, under gates (refine/refine.h). The published program is paper/deliso.h.
#pragma once

#include <span>
#include <vector>

#include "mesh/tri_mesh.h"
#include "run/options.h"
#include "run/report.h"
#include "surface/boundary.h"
#include "surface/surface_mesh.h"
#include "volume/volume.h"

namespace deliso {

struct ContourMesh;

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
// vertex; its triangles are released. `curves`: T's boundary. `samples`: the reference samples of
// Refine, vertices of T.
SurfaceMesh delaunay_mesh(const Isosurface& surface, ContourMesh& contour,
                          const BoundaryCurves& curves, std::span<const Vec3> samples,
                          const Options& options, const Parameters& parameters, Report& report);

}  // namespace deliso
