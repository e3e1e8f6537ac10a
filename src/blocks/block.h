// SPDX-License-Identifier: MIT
// One block: its samples, Figure 4 on them, and the seam. It runs in one thread, and knows nothing
// of other blocks but the planes of the grid.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "blocks/components.h"
#include "blocks/grid.h"
#include "deliso/options.h"
#include "isosurface/isosurface.h"
#include "kdtree/voxel_tree.h"
#include "surface/boundary.h"
#include "surface/report.h"
#include "surface/surface_mesh.h"

namespace deliso {

// The surface in a box of a volume.
struct BoxSurface {
  BoxSurface(Volume of_box, double kappa, CubicMethod cubic);
  BoxSurface(const BoxSurface&) = delete;

  Volume volume;
  VoxelTree tree;
  Isosurface surface;
};

struct Block {
  SampleBox box;
  BlockComponents components;
  SurfaceMesh mesh;
  std::shared_ptr<const BoundaryLoops> loops;  // of its chain
  // Reference samples, vertices of T: those near inner faces; and with a desired count the others.
  std::vector<Vec3> samples_near_seams, samples;
  // The inner faces at which no seam could be made (blocks/seam.h).
  unsigned refused = 0;
  bool is_refined = false;  // with a desired count: to the last bound, with its seam
  Report report;
};

// What all blocks of a run have in common.
struct BlockRun {
  const Volume& volume;
  double kappa;
  const Options& options;
  const Parameters& parameters;
  const BlockGrid& grid;
};

// Meshes a block. With a desired count it ends with Stage 1. `kept`: per component of the block's
// contour, nonzero if it is kept; empty: all are.
Block mesh_block(const BlockRun& run, const SampleBox& box, std::span<const std::uint8_t> kept);

// Stage 2 once more, with other criteria.
void refine_block(const BlockRun& run, const Parameters& parameters, Block& block);

// Removes everything but the seam from the inner faces. Sets block.refused.
void make_seam(const BlockRun& run, Block& block);

}  // namespace deliso
