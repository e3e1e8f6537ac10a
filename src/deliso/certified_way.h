// SPDX-License-Identifier: MIT
// Both stages by turns, the certified way: Stage 1 on the exact contour, Stage 2 on what it hands
// over, and where Stage 2 leaves trouble (trouble.h) the contour is made finer and the turn begins
// again, with all sites that are still vertices of T. No voxel is split twice, so it ends; options
// limit the turns. The least troubled mesh of all turns is the result, once its patches are
// Delaunay where they can be (delaunay_patches.h) and its vertices stand where they do best
// (move_vertices.h).
#pragma once

#include "contour/contour.h"
#include "surface/boundary.h"
#include "surface/options.h"
#include "surface/surface_mesh.h"
#include "surface/report.h"
#include "isosurface/isosurface.h"

namespace deliso {

struct CertifiedMesh {
  Recovered refined;      // by Stage 2; as Stage 1 handed it over with options.stop_after_recover
  BoundaryCurves curves;  // that its chain is on
};

// `contour` is the plain one, with at least one vertex.
CertifiedMesh mesh_certified(const Isosurface& surface, ContourMesh&& contour,
                             const Options& options, Report& report);

}  // namespace deliso
