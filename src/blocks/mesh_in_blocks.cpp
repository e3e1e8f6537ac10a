// SPDX-License-Identifier: MIT
#include "blocks/mesh_in_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "base/text.h"
#include "blocks/order.h"
#include "blocks/seams.h"
#include "blocks/weld.h"
#include "contour/contour.h"
#include "run/observer.h"

namespace deliso {
namespace {

// Voxels of the largest volume whose samples decide the grid. A block may have all of it, and a
// part reads all.
constexpr std::uint64_t kMostFollowedVoxels = std::uint64_t{1} << 28;

// Returns the work in the volume if the grid follows from it.
std::optional<SurfaceWork> deciding_work(const RunInput& run) {
  if (follower(run.parameters.observer) || !grid_follows_surface(run.source.shape, run.options)) {
    return {};
  }
  return SurfaceWork(run.source, run.kappa, run.options.threads);
}

BlockGrid grid_for(const std::optional<SurfaceWork>& work, const RunInput& run) {
  if (work) return grid_at_equal_shares(*work);
  // Who follows insertions sees them in one order.
  return follower(run.parameters.observer) ? BlockGrid(run.source.shape, 0)
                                           : block_grid(run.source.shape, run.options);
}

Parameters in_block(const Parameters& given, const BlockGrid& grid) {
  Parameters p = given;
  p.leaves_seams = grid.is_divided();
  if (p.leaves_seams) p.observer = nullptr;
  return p;
}

// Throws unless the mesh ends only where its chain runs, on the box, and the chain never comes back
// to a place: where parts fit together.
void require_closed(const Block& whole, const Box3& box) {
  const SurfaceMesh& s = whole.mesh;
  std::vector<Vec3> ends;
  bool is_closed = ends_on_chain(s);
  for (VertexId v = 0; v < s.mesh.points.size() && is_closed; ++v) {
    if (!s.chain.is_boundary(v)) continue;
    ends.push_back(s.mesh.points[v]);
    is_closed = on_one_face(ends.back(), s.mesh.points[s.chain.next(v)], box);
  }
  std::ranges::sort(ends, {}, by_place);
  is_closed &= std::ranges::adjacent_find(ends) == ends.end();
  if (!is_closed) throw InputError("the seams of the parts do not fit together");
}

// Refines a welded mesh at the seams that are due, and puts it in order. Throws InputError beyond
// max_vertices. Returns it.
Block refined_at_seams(const RunInput& run, const BlockGrid& grid, Block whole,
                       const IsDue& is_due) {
  if (grid.is_divided()) {
    const Parameters parameters = in_block(run.parameters, grid);
    const BlockRun in_blocks{{run.source, run.kappa, run.options, parameters}, grid};
    if (!run.options.stop_after_stage1) {
      refine_seams(in_blocks, whole, is_due, run.parameters.observer);
    }
    order_by_place(whole, grid, run.source.shape, run.options.threads);
  }
  if (whole.mesh.mesh.points.size() > run.parameters.max_vertices) {
    throw InputError("more than --max-vertices ", run.parameters.max_vertices, " vertices needed");
  }
  return whole;
}

}  // namespace

bool grid_follows_surface(const Grid& shape, const Options& options) {
  const Index3 voxels = shape.voxels();
  return options.block_side == Options::kUsualSide &&
         std::uint64_t(voxels.i) * voxels.j * voxels.k <= kMostFollowedVoxels;
}

BlockGrid block_grid(const VolumeSource& source, double isovalue, const Options& options) {
  if (!grid_follows_surface(source.shape, options)) return block_grid(source.shape, options);
  return grid_at_equal_shares(SurfaceWork(source, isovalue, options.threads));
}

BlockGrid block_grid(const Grid& shape, const Options& options) {
  const bool is_usual = options.block_side == Options::kUsualSide;
  return BlockGrid(shape, is_usual ? usual_block_side(shape) : options.block_side);
}

PartInBlocks::PartInBlocks(const RunInput& run, PartChoice part, std::vector<std::uint8_t> kept)
    : work_(deciding_work(run)),
      grid_(grid_for(work_, run)),
      cells_(grid_.boxes()),
      own_(cells_of(part, cells_.size())),
      kept_(std::move(kept)) {
  for (std::size_t n = own_.begin; n < own_.end; ++n) blocks_.emplace_back().box = cells_[n];
}

// Calls work(run of blocks, block) for all blocks, those with the most work first, if it is known.
template <class Work>
void PartInBlocks::for_each_block(const RunInput& run, Work&& work) {
  const Parameters parameters = in_block(run.parameters, grid_);
  const BlockRun in_blocks{{run.source, run.kappa, run.options, parameters}, grid_};
  std::vector<std::size_t> numbers(blocks_.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  std::vector<std::size_t> weight(blocks_.size(), 1);
  for (std::size_t n = 0; work_ && n < weight.size(); ++n) weight[n] += work_->in(blocks_[n].box);
  std::ranges::stable_sort(numbers, std::ranges::greater(),
                           [&](std::size_t n) { return weight[n]; });
  Observer* const observer = grid_.is_divided() ? run.parameters.observer : nullptr;
  begin_stage(observer, "blocks");
  std::mutex mutex;
  std::size_t done = 0, left = std::accumulate(weight.begin(), weight.end(), std::size_t{0});
  for_each_task(run.options.threads, numbers.size(), [&](std::size_t n) {
    work(in_blocks, numbers[n]);
    const std::lock_guard lock(mutex);
    done += weight[numbers[n]];
    left -= weight[numbers[n]];
    if (observer) observer->steps_done(done, left);
  });
}

// Returns per block which of its components are kept; empty: all are. Counts the others in
// skipped_.
std::vector<std::vector<std::uint8_t>> PartInBlocks::choose_components(const RunInput& run) {
  if (blocks_.empty() || (kept_.empty() && run.options.components.is_all())) return {};
  std::vector<SampleBox> boxes;
  for (const Block& block : blocks_) boxes.push_back(block.box);
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
    if (!own_.holds(cell)) boxes.push_back(cells_[cell]);
  }
  std::vector<BlockComponents> components(boxes.size());
  for_each_task(run.options.threads, boxes.size(), [&](std::size_t n) {
    const Volume volume = run.source.read(boxes[n]);
    components[n] = components_of(build_contour(volume, run.kappa), volume);
  });
  AllComponents known = joined(components, run.source.shape.dims());
  ContourSummary summary;
  summary.components = std::move(known.components);
  const std::vector<std::uint8_t> kept =
      kept_.empty() ? chosen_components(summary, run.options.components) : kept_;
  DELISO_CHECK(kept.size() == summary.components.size());
  skipped_ = static_cast<std::uint64_t>(std::ranges::count(kept, 0));
  std::vector<std::vector<std::uint8_t>> of_block;
  for (std::size_t n = 0; n < blocks_.size(); ++n) {
    std::vector<std::uint8_t>& own = of_block.emplace_back();
    for (const std::uint32_t c : known.number[n]) own.push_back(kept[c]);
  }
  return of_block;
}

void PartInBlocks::mesh(const RunInput& run) {
  const std::vector<std::vector<std::uint8_t>> kept = choose_components(run);
  for_each_block(run, [&](const BlockRun& in_blocks, std::size_t n) {
    const std::span<const std::uint8_t> own =
        kept.empty() ? std::span<const std::uint8_t>() : kept[n];
    blocks_[n] = mesh_block(in_blocks, blocks_[n].box, own);
  });
}

void PartInBlocks::coarsen(const RunInput& run) {
  for_each_block(
      run, [&](const BlockRun& in_blocks, std::size_t n) { coarsen_block(in_blocks, blocks_[n]); });
}

void PartInBlocks::refine(const RunInput& run) {
  for_each_block(
      run, [&](const BlockRun& in_blocks, std::size_t n) { refine_block(in_blocks, blocks_[n]); });
}

Block PartInBlocks::welded(const RunInput& run) {
  if (blocks_.empty()) return {};
  if (grid_.is_divided()) {
    begin_stage(run.parameters.observer, "weld");
    for_each_task(run.options.threads, blocks_.size(),
                  [&](std::size_t n) { mark_seam_work(blocks_[n]); });
  }
  Block whole = weld(blocks_, run.source.shape, [&](Index3 voxel) {
    return !own_.holds(grid_.number_of(grid_.cell_of(voxel)));
  });
  whole.report[Counter::components_skipped] = skipped_;
  return refined_at_seams(run, grid_, std::move(whole), [&](std::span<const std::size_t> cells) {
    return std::ranges::all_of(cells, [&](std::size_t cell) { return own_.holds(cell); });
  });
}

Block mesh_in_blocks(const RunInput& run, PartChoice part, std::vector<std::uint8_t> kept) {
  PartInBlocks blocks(run, part, std::move(kept));
  blocks.mesh(run);
  return blocks.welded(run);
}

Block join_parts(const RunInput& run, std::vector<Block> parts) {
  const BlockGrid grid = grid_for(deciding_work(run), run);
  const std::size_t cells = grid.boxes().size();
  std::vector<std::size_t> part_of(cells);
  const int of = static_cast<int>(parts.size());
  std::vector<Block> with_cells;
  for (int number = 1; number <= of; ++number) {
    const CellRun own = cells_of({number, of}, cells);
    for (std::size_t n = own.begin; n < own.end; ++n) part_of[n] = with_cells.size();
    if (own.begin == own.end) continue;
    with_cells.push_back(std::move(parts[number - 1]));
    // Each part has counted those of the whole.
    std::uint64_t& skipped = with_cells.back().report[Counter::components_skipped];
    if (with_cells.size() > 1) skipped = 0;
  }
  begin_stage(run.parameters.observer, "weld");
  Block whole = weld(with_cells, run.source.shape, nullptr);
  require_closed(whole, run.source.shape.box());
  return refined_at_seams(run, grid, std::move(whole), [&](std::span<const std::size_t> box) {
    return std::ranges::any_of(box,
                               [&](std::size_t cell) { return part_of[cell] != part_of[box[0]]; });
  });
}

}  // namespace deliso
