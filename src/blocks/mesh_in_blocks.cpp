// SPDX-License-Identifier: MIT
#include "blocks/mesh_in_blocks.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "base/text.h"
#include "blocks/equal_shares.h"
#include "blocks/order.h"
#include "blocks/seams.h"
#include "blocks/weld.h"
#include "contour/contour.h"
#include "run/observer.h"

namespace deliso {
namespace {

// A mesh of a desired size is coarsened from one with at least the first of these times as many
// vertices or triangles, and if possible no more than the second: from a finer one it would be
// worse.
constexpr double kLeastRatio = 1.3, kMostRatio = 2;

// The first bound on the distance for such a mesh, in voxels, and the last ones, where it has too
// many or too few vertices; and by how much a bound is changed at once.
constexpr double kFirstDistanceVoxels = 0.05, kLargestDistanceVoxels = 2,
                 kSmallestDistanceVoxels = 2e-3;
constexpr double kLeastGrowth = 1.2, kMostGrowth = 3, kLeastFall = 0.25, kMostFall = 0.7;

// Along each axis, of volumes whose samples decide the grid.
constexpr int kMostFollowedVoxels = 512;

// Returns the work in the volume if the grid follows from it.
std::optional<SurfaceWork> deciding_work(const VolumeSource& source, double kappa,
                                         const Options& options, const Parameters& parameters) {
  if (follower(parameters.observer) || !grid_follows_surface(source.shape, options)) return {};
  return SurfaceWork(source, kappa, options.threads);
}

BlockGrid grid_for(const std::optional<SurfaceWork>& work, const Volume& shape,
                   const Options& options, const Parameters& parameters) {
  if (work) return BlockGrid(planes_at_equal_shares(*work));
  // Who follows insertions sees them in one order.
  return follower(parameters.observer) ? BlockGrid(shape, 0) : block_grid(shape, options);
}

Parameters in_block(const Parameters& given, bool is_divided) {
  Parameters p = given;
  if (is_divided) p.observer = nullptr;
  p.leaves_seams = is_divided;
  if (p.has_target()) p.max_vertices = Parameters::kNoTarget;
  return p;
}

void require_room(const Block& block, const Parameters& given) {
  if (given.has_target() || block.mesh.mesh.points.size() <= given.max_vertices) return;
  throw InputError("more than --max-vertices ", given.max_vertices, " vertices needed");
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

// Refines at the seams that are due, and puts the whole in order. Returns it.
Block finished(const BlockRun& run, Block whole, const IsDue& is_due, const Parameters& given,
               Report& report) {
  if (run.grid.cells() != Index3{1, 1, 1}) {
    if (!run.options.stop_after_stage1) refine_seams(run, whole, is_due, given.observer);
    order_by_place(whole, run.grid, run.source.shape, run.options.threads);
  }
  report.add(whole.report);
  require_room(whole, given);
  return whole;
}

class BlockMesher {
 public:
  BlockMesher(const VolumeSource& source, double kappa, const Options& options,
              const Parameters& parameters, std::vector<std::uint8_t> kept, PartChoice part,
              Report& report)
      : options_(options),
        given_(parameters),
        work_(deciding_work(source, kappa, options, parameters)),
        grid_(grid_for(work_, source.shape, options, parameters)),
        cells_(grid_.boxes()),
        part_(part),
        own_(cells_of(part, cells_.size())),
        parameters_(in_block(parameters, cells_.size() > 1)),
        run_{source, kappa, options_, parameters_, grid_},
        kept_(std::move(kept)),
        report_(report) {
    for (std::size_t n = own_.begin; n < own_.end; ++n) blocks_.emplace_back().box = cells_[n];
  }

  Block run() {
    if (blocks_.empty()) return {};
    if (given_.has_target()) {
      parameters_.refinement[Criterion::distance] = kFirstDistanceVoxels * given_.voxel;
    }
    mesh_blocks();
    if (given_.has_target()) meet_target();
    if (cells_.size() > 1) {
      begin_stage(given_.observer, "weld");
      for_each_task(options_.threads, blocks_.size(),
                    [&](std::size_t n) { mark_seam_work(blocks_[n]); });
    }
    Block whole = weld(blocks_, run_.source.shape.spacing(), [&](Index3 voxel) {
      return !own_.holds(grid_.number_of(grid_.cell_of(voxel)));
    });
    const IsDue is_within = [&](std::span<const std::size_t> cells) {
      return std::ranges::all_of(cells, [&](std::size_t cell) { return own_.holds(cell); });
    };
    return finished(run_, std::move(whole), is_within, given_, report_);
  }

 private:
  // Calls work(block) for all blocks, those with the most work first, if it is known.
  template <class Work>
  void for_each_block(Work&& work) {
    std::vector<std::size_t> numbers(blocks_.size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    std::vector<std::size_t> weight(blocks_.size(), 1);
    for (std::size_t n = 0; work_ && n < weight.size(); ++n) weight[n] += work_->in(blocks_[n].box);
    std::ranges::stable_sort(numbers, std::ranges::greater(),
                             [&](std::size_t n) { return weight[n]; });
    Observer* const observer = cells_.size() > 1 ? given_.observer : nullptr;
    begin_stage(observer, "blocks");
    std::mutex mutex;
    std::size_t done = 0, left = std::accumulate(weight.begin(), weight.end(), std::size_t{0});
    for_each_task(options_.threads, numbers.size(), [&](std::size_t n) {
      work(numbers[n]);
      const std::lock_guard lock(mutex);
      done += weight[numbers[n]];
      left -= weight[numbers[n]];
      if (observer) observer->steps_done(done, left);
    });
  }

  // Returns per block which of its components are kept; empty: all are.
  std::vector<std::vector<std::uint8_t>> choose_components() {
    if (kept_.empty() && options_.components.is_all()) return {};
    std::vector<SampleBox> boxes;
    for (const Block& block : blocks_) boxes.push_back(block.box);
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
      if (!own_.holds(cell)) boxes.push_back(cells_[cell]);
    }
    std::vector<BlockComponents> components(boxes.size());
    for_each_task(options_.threads, boxes.size(), [&](std::size_t n) {
      const Volume volume = run_.source.read(boxes[n]);
      components[n] = components_of(build_contour(volume, run_.kappa), volume);
    });
    AllComponents known = joined(components, run_.source.shape.dims());
    ContourSummary summary;
    summary.components = std::move(known.components);
    const std::vector<std::uint8_t> kept =
        kept_.empty() ? chosen_components(summary, options_.components) : kept_;
    DELISO_CHECK(kept.size() == summary.components.size());
    report_[Counter::components_skipped] = static_cast<std::uint64_t>(std::ranges::count(kept, 0));
    std::vector<std::vector<std::uint8_t>> of_block;
    for (std::size_t n = 0; n < blocks_.size(); ++n) {
      std::vector<std::uint8_t>& own = of_block.emplace_back();
      for (const std::uint32_t c : known.number[n]) own.push_back(kept[c]);
    }
    return of_block;
  }

  void mesh_blocks() {
    const std::vector<std::vector<std::uint8_t>> kept = choose_components();
    for_each_block([&](std::size_t n) {
      const std::span<const std::uint8_t> own =
          kept.empty() ? std::span<const std::uint8_t>() : kept[n];
      blocks_[n] = mesh_block(run_, blocks_[n].box, own);
    });
  }

  // Returns the vertices or triangles, without those at seams: most of these will be thinned.
  std::size_t counted() const {
    std::size_t count = 0;
    for (const Block& block : blocks_) {
      const SurfaceMesh& s = block.mesh;
      const auto is_counted = [&](VertexId v) { return !is_on_seam(block, v); };
      if (given_.target_triangles == Parameters::kNoTarget) {
        for (VertexId v = 0; v < s.mesh.points.size(); ++v) count += is_counted(v);
      } else {
        for (const Face& face : s.mesh.faces) count += std::ranges::all_of(face.v, is_counted);
      }
    }
    return count;
  }

  // Coarsens all blocks by bounds on the distance that grow, until they have not many more vertices
  // or triangles than desired; then refines them, by bounds that shrink if they have too few.
  void meet_target() {
    const auto target =
        static_cast<double>(std::min(given_.target_triangles, given_.target_vertices));
    double& bound = parameters_.refinement[Criterion::distance];
    const double voxel = given_.voxel;
    for (;;) {
      const double ratio = static_cast<double>(counted()) / target;
      if (ratio <= kMostRatio || bound >= kLargestDistanceVoxels * voxel) break;
      // The number falls slower than the bound grows.
      bound = std::min(std::clamp(ratio, kLeastGrowth, kMostGrowth) * bound,
                       kLargestDistanceVoxels * voxel);
      for_each_block([&](std::size_t n) { coarsen_block(run_, blocks_[n]); });
    }
    for (;;) {
      for_each_block([&](std::size_t n) { refine_block(run_, blocks_[n]); });
      const double ratio = static_cast<double>(counted()) / target;
      if (ratio >= kLeastRatio || bound <= kSmallestDistanceVoxels * voxel) break;
      bound = std::max(std::clamp(ratio / kMostRatio, kLeastFall, kMostFall) * bound,
                       kSmallestDistanceVoxels * voxel);
    }
  }

  const Options options_;
  const Parameters& given_;
  const std::optional<SurfaceWork> work_;
  const BlockGrid grid_;
  const std::vector<SampleBox> cells_;
  const PartChoice part_;
  const CellRun own_;
  Parameters parameters_;  // in blocks
  const BlockRun run_;
  const std::vector<std::uint8_t> kept_;
  Report& report_;
  std::vector<Block> blocks_;
};

}  // namespace

bool grid_follows_surface(const Volume& shape, const Options& options) {
  const Index3 voxels = shape.voxels();
  return options.block_side == Options::kUsualSide &&
         std::max({voxels.i, voxels.j, voxels.k}) <= kMostFollowedVoxels;
}

BlockGrid block_grid(const VolumeSource& source, double isovalue, const Options& options) {
  if (!grid_follows_surface(source.shape, options)) return block_grid(source.shape, options);
  return BlockGrid(planes_at_equal_shares(SurfaceWork(source, isovalue, options.threads)));
}

BlockGrid block_grid(const Volume& shape, const Options& options) {
  const bool is_usual = options.block_side == Options::kUsualSide;
  return BlockGrid(shape, is_usual ? usual_block_side(shape) : options.block_side);
}

Block mesh_in_blocks(const VolumeSource& source, double kappa, const Options& options,
                     const Parameters& parameters, std::vector<std::uint8_t> kept, PartChoice part,
                     Report& report) {
  return BlockMesher(source, kappa, options, parameters, std::move(kept), part, report).run();
}

Block join_parts(const VolumeSource& source, double kappa, const Options& options,
                 const Parameters& parameters, std::vector<Block> parts, Report& report) {
  const BlockGrid grid = grid_for(deciding_work(source, kappa, options, parameters), source.shape,
                                  options, parameters);
  const Parameters in_blocks = in_block(parameters, true);
  const BlockRun run{source, kappa, options, in_blocks, grid};
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
  begin_stage(parameters.observer, "weld");
  Block whole = weld(with_cells, source.shape.spacing(), nullptr);
  require_closed(whole, source.shape.box());
  const IsDue is_between = [&](std::span<const std::size_t> box) {
    return std::ranges::any_of(box,
                               [&](std::size_t cell) { return part_of[cell] != part_of[box[0]]; });
  };
  return finished(run, std::move(whole), is_between, parameters, report);
}

}  // namespace deliso
