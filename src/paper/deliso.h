// SPDX-License-Identifier: MIT
// DelIso(f, kappa) of paper Figure 4, as published: a thin driver of the primitives in delaunay,
// mesh, volume, kdtree and roots. The exact program, blocks/block.h, has nothing of it.
//
// Its tests miss pieces of Sigma: a component that no line of InitTriangulation meets, a neck that
// no Voronoi edge meets. They are lost, and the mesh is sound without them. Options::facet_cycles
// asks for more.
#pragma once

#include "base/stopwatch.h"
#include "kdtree/voxel_tree.h"
#include "mesh/tri_mesh.h"
#include "paper/options.h"
#include "paper/recover.h"
#include "paper/refine.h"
#include "paper/report.h"
#include "volume/volume.h"

namespace deliso::paper {

// Returns the mesh of {g = kappa} in the scaled frame, with the frame of the volume. Facets are
// counter-clockwise seen from g < kappa. Throws InputError for a volume without a voxel, if no line
// meets Sigma, and beyond max_vertices. pre: all samples are finite; lambda >= 1, r_min > 0.
TriMesh deliso(const Volume& volume, double isovalue, const Options& options, Report& report);

// What Figure 4 begins and ends with, whatever is Stage 1 (recover/certified.h has another): the
// kd-tree, kappa and r_min; then RefineGeom, if pole heights are known. Returns the mesh of t.
VoxelTree begin_run(const Volume& volume, double isovalue, const Options& options, Report& report);
TriMesh finish(SurfaceMesh t, const Sigma& sigma, const Options& options, Report& report);

// Runs a step, with its time and its name for the observer.
template <class Run>
auto stage(const char* name, double& seconds, const Options& options, Run&& run) {
  begin_stage(options.observer, name);
  const StepTimer timer(seconds);
  return run();
}

// InitTriangulation: S_0 is where random lines through the box meet Sigma, and the points of the
// boundary curves (§5). Four auxiliary vertices far outside the box make Del S_0 three-dimensional.
Recovery init_triangulation(Sigma& sigma, const Options& options, Report& report);

}  // namespace deliso::paper
