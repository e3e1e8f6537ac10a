// SPDX-License-Identifier: MIT
#include "more/counts/mesh_near_count.h"

#include <algorithm>
#include <utility>

namespace deliso {
namespace {

// A mesh of a desired size is made from one with at least the first of these times as many
// vertices or triangles, and if possible no more than the second: from a finer one it would be
// worse.
constexpr double kLeastRatio = 1.3, kMostRatio = 2;

// The first bound on the distance for such a mesh, in voxels, and the last ones, where it has too
// many or too few vertices; and by how much a bound is changed at once.
constexpr double kFirstDistanceVoxels = 0.05, kLargestDistanceVoxels = 2,
                 kSmallestDistanceVoxels = 2e-3;
constexpr double kLeastGrowth = 1.2, kMostGrowth = 3, kLeastFall = 0.25, kMostFall = 0.7;

// Returns the vertices or triangles, without those at seams: most of these will be removed.
std::size_t counted(std::span<const Block> blocks, bool triangles) {
  std::size_t count = 0;
  for (const Block& block : blocks) {
    const TriMesh& mesh = block.mesh.mesh;
    const auto is_counted = [&](VertexId v) { return !is_on_seam(block, v); };
    if (triangles) {
      for (const Face& face : mesh.faces) count += std::ranges::all_of(face.v, is_counted);
    } else {
      for (VertexId v = 0; v < mesh.points.size(); ++v) count += is_counted(v);
    }
  }
  return count;
}

}  // namespace

// Coarsens all blocks by bounds that grow, until they have not many more than desired; then refines
// them, by bounds that shrink if they have too few.
Block mesh_near_count(const RunInput& run, std::vector<std::uint8_t> kept) {
  const Options& options = run.options;
  const bool triangles = options.target_triangles != Options::kNoTarget;
  const auto target =
      static_cast<double>(std::min(options.target_triangles, options.target_vertices));
  const double voxel = run.parameters.voxel;
  const auto at_bound = [&](double bound) {
    Parameters parameters = run.parameters;
    parameters.max_vertices = Options::kNoTarget;
    parameters.refinement[Criterion::distance] = bound;
    return parameters;
  };
  Options stage1 = options;
  stage1.stop_after_stage1 = true;
  PartInBlocks blocks(run, {}, std::move(kept));
  const auto ratio = [&] {
    return static_cast<double>(counted(blocks.blocks(), triangles)) / target;
  };

  double bound = kFirstDistanceVoxels * voxel;
  blocks.mesh({run.source, run.kappa, stage1, at_bound(bound)});
  while (bound < kLargestDistanceVoxels * voxel) {
    const double now = ratio();
    if (now <= kMostRatio) break;
    // The number falls slower than the bound grows.
    bound = std::min(std::clamp(now, kLeastGrowth, kMostGrowth) * bound,
                     kLargestDistanceVoxels * voxel);
    blocks.coarsen({run.source, run.kappa, options, at_bound(bound)});
  }
  for (;;) {
    blocks.refine({run.source, run.kappa, options, at_bound(bound)});
    const double now = ratio();
    if (now >= kLeastRatio || bound <= kSmallestDistanceVoxels * voxel) break;
    bound = std::max(std::clamp(now / kMostRatio, kLeastFall, kMostFall) * bound,
                     kSmallestDistanceVoxels * voxel);
  }
  return blocks.welded({run.source, run.kappa, options, at_bound(bound)});
}

}  // namespace deliso
