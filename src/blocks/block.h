// SPDX-License-Identifier: MIT
// One block: its samples, and both stages on them. It runs in one thread, and knows nothing of
// other blocks but the planes of the grid. On its inner faces the mesh keeps all vertices of T.
// Blocks that are welded (blocks/weld.h) are a block again.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "blocks/components.h"
#include "blocks/grid.h"
#include "isosurface/box_surface.h"
#include "run/options.h"
#include "run/report.h"
#include "surface/boundary.h"
#include "surface/surface_mesh.h"
#include "volume/volume_source.h"

namespace deliso {

struct Block {
  SampleBox box;                            // of one that is not welded
  std::vector<BlockComponents> components;  // of each that was welded
  SurfaceMesh mesh;
  std::shared_ptr<const BoundaryLoops> loops;  // of its chain
  // Reference samples, vertices of T: those near inner faces; and, of a block that ended with Stage
  // 1, the others.
  std::vector<Vec3> samples_near_seams, samples;
  // What is left to do at seams: nonzero for facets to refine, and for vertices with which
  // coarsening begins. Both are empty until mark_seam_work().
  IdArray<FaceId, std::uint8_t> is_open;
  IdArray<VertexId, std::uint8_t> may_thin;
  Report report;
};

// What a run meshes, and how. `parameters`: resolve() of the options, perhaps with other limits.
struct RunInput {
  const VolumeSource& source;
  double kappa;
  const Options& options;
  const Parameters& parameters;
};
// The same with what its blocks have in common. `parameters` are then those in a block.
struct BlockRun : RunInput {
  const BlockGrid& grid;
};

// Figure 4 of the exact program: T, coarsened, then refined. `kept`: per component of the block's
// contour, nonzero if it is kept; empty: all are. With options.stop_after_stage1 the mesh is the
// coarsened contour.
Block mesh_block(const BlockRun& run, const SampleBox& box, std::span<const std::uint8_t> kept);

// One of the stages once more, by other criteria. pre: the block ended with Stage 1.
void coarsen_block(const BlockRun& run, Block& block);
void refine_block(const BlockRun& run, Block& block);

// True if the vertex lies on a seam.
bool is_on_seam(const Block& block, VertexId v);

// Marks the facets with a vertex on a seam as open, and the vertices up to two edges from one as
// those with which coarsening begins. pre: the block is not welded.
void mark_seam_work(Block& block);

}  // namespace deliso
