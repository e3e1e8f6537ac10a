// SPDX-License-Identifier: MIT
#include "blocks/mesh_in_blocks.h"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "base/text.h"
#include "blocks/seams.h"
#include "contour/contour.h"
#include "refine/coarsen.h"
#include "surface/observer.h"

namespace deliso {
namespace {

// Crossings are estimated from every so many rows of samples.
constexpr int kRowStride = 4;

// Returns about how many grid edges along x the surface crosses in the box, less all but every
// 16th: the weight of a block's work.
std::size_t weight_of(const Volume& volume, double kappa, const SampleBox& box) {
  const Index3 first = volume.first();
  return volume.visit([&](const auto* samples) {
    std::size_t crossings = 1;
    for (int k = box.begin.k - first.k; k <= box.end.k - first.k; k += kRowStride) {
      for (int j = box.begin.j - first.j; j <= box.end.j - first.j; j += kRowStride) {
        const auto* row = samples + volume.index(box.begin.i - first.i, j, k);
        for (int i = 0; i < box.end.i - box.begin.i; ++i) {
          crossings +=
              (static_cast<double>(row[i]) >= kappa) != (static_cast<double>(row[i + 1]) >= kappa);
        }
      }
    }
    return crossings;
  });
}

class BlockMesher {
 public:
  BlockMesher(const Volume& volume, double kappa, const Options& options,
              const Parameters& parameters, std::vector<std::uint8_t> kept, Report& report)
      : options_(options),
        given_(parameters),
        parameters_(in_block(parameters)),
        grid_(volume, side(options, parameters, volume)),
        run_{volume, kappa, options_, parameters_, grid_},
        kept_(std::move(kept)),
        report_(report) {
    for (const SampleBox& box : grid_.boxes()) blocks_.emplace_back().box = box;
    if (blocks_.size() == 1) parameters_.observer = given_.observer;
    parameters_.leaves_seams = blocks_.size() > 1;
  }

  WeldedMesh run() {
    mesh_blocks(all());
    count_topology();
    if (given_.has_target()) refine_to_target();
    for (const Block& block : blocks_) report_.add(block.report);
    const bool has_seams = blocks_.size() > 1;
    if (has_seams) begin_stage(given_.observer, "weld");
    WeldedMesh whole = weld(blocks_);
    if (has_seams && !options_.stop_after_recover) {
      refine_seams(run_, whole, options_.threads, given_.observer, report_);
    }
    if (!given_.has_target()) require_room(whole.mesh.mesh.points.size());
    return whole;
  }

 private:
  // Poles of a block, and the order of the paper's insertions, are not those of the whole.
  static int side(const Options& options, const Parameters& parameters, const Volume& volume) {
    const bool is_one = options.recover == RecoverWay::paper || parameters.asks_for_poles() ||
                        follower(parameters.observer) || volume.is_block();
    if (is_one) return 0;
    return options.block_side == Options::kUsualSide ? usual_block_side(volume)
                                                     : options.block_side;
  }

  static Parameters in_block(Parameters p) {
    p.observer = nullptr;
    if (p.has_target()) p.max_vertices = Parameters::kNoTarget;
    return p;
  }

  void require_room(std::size_t vertices) const {
    if (vertices <= given_.max_vertices) return;
    throw InputError(text("more than --max-vertices ", given_.max_vertices, " vertices needed"));
  }

  // Calls work(block) for the blocks with these numbers, those with the most crossings first.
  template <class Work>
  void for_each_block(std::vector<std::size_t> numbers, Work&& work) {
    std::vector<std::size_t> weight(blocks_.size(), 0);
    for_each_task(options_.threads, numbers.size(), [&](std::size_t n) {
      weight[numbers[n]] = weight_of(run_.volume, run_.kappa, blocks_[numbers[n]].box);
    });
    std::ranges::stable_sort(numbers, std::ranges::greater(),
                             [&](std::size_t n) { return weight[n]; });
    Observer* const observer = blocks_.size() > 1 ? given_.observer : nullptr;
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

  std::vector<std::size_t> all() const {
    std::vector<std::size_t> numbers(blocks_.size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    return numbers;
  }

  // Returns per block which of its components are kept; empty: all are.
  std::vector<std::vector<std::uint8_t>> choose_components() {
    if (kept_.empty() && options_.components.is_all()) return {};
    std::vector<BlockComponents> components(blocks_.size());
    for_each_task(options_.threads, blocks_.size(), [&](std::size_t n) {
      const Volume volume = samples_of(run_.volume, blocks_[n].box);
      components[n] = components_of(build_contour(volume, run_.kappa), volume);
    });
    AllComponents known = joined(components, run_.volume.whole_dims());
    ContourSummary summary;
    summary.components = std::move(known.components);
    const std::vector<std::uint8_t> kept =
        kept_.empty() ? chosen_components(summary, options_.components) : kept_;
    DELISO_CHECK(kept.size() == summary.components.size());
    report_[Counter::components_skipped] = static_cast<std::uint64_t>(std::ranges::count(kept, 0));
    std::vector<std::vector<std::uint8_t>> of_block;
    for (const std::vector<std::uint32_t>& numbers : known.number) {
      std::vector<std::uint8_t>& own = of_block.emplace_back();
      for (const std::uint32_t c : numbers) own.push_back(kept[c]);
    }
    return of_block;
  }

  // Meshes these blocks. Where a seam is refused, the blocks at it become one, which is meshed
  // again.
  void mesh_blocks(std::vector<std::size_t> todo) {
    while (!todo.empty()) {
      const std::vector<std::vector<std::uint8_t>> kept = choose_components();
      for_each_block(todo, [&](std::size_t n) {
        const std::span<const std::uint8_t> own =
            kept.empty() ? std::span<const std::uint8_t>() : kept[n];
        blocks_[n] = mesh_block(run_, blocks_[n].box, own);
      });
      todo = merge_refused();
    }
  }

  void count_topology() {
    std::vector<BlockComponents> components;
    for (Block& block : blocks_) components.push_back(std::move(block.components));
    report_.exact = joined(components, run_.volume.whole_dims()).topology;
  }

  // Returns the numbers of the new blocks.
  std::vector<std::size_t> merge_refused() {
    std::vector<SampleBox> boxes, fresh;
    for (const Block& block : blocks_) boxes.push_back(block.box);
    for (const Block& block : blocks_) {
      if (block.refused == 0) continue;
      // An earlier merge may have taken it already.
      if (std::ranges::find(boxes, block.box) == boxes.end()) continue;
      if (run_.volume.is_block()) {
        throw InputError(
            "the surface is too fine for a seam (another --seed may do, or other blocks)");
      }
      const SampleBox box = merged(grid_, boxes, block.box, block.refused);
      std::erase_if(boxes, [&](const SampleBox& other) { return is_in(other, box); });
      std::erase_if(fresh, [&](const SampleBox& other) { return is_in(other, box); });
      boxes.push_back(box);
      fresh.push_back(box);
    }
    if (fresh.empty()) return {};
    std::erase_if(blocks_, [&](const Block& block) {
      return std::ranges::find(boxes, block.box) == boxes.end() || block.refused != 0;
    });
    std::vector<std::size_t> numbers;
    for (const SampleBox& box : fresh) {
      numbers.push_back(blocks_.size());
      blocks_.emplace_back().box = box;
    }
    report_[Counter::seams_refused] += fresh.size();
    return numbers;
  }

  // Refines all blocks by bounds on the distance that shrink, until they have enough vertices or
  // triangles to be coarsened.
  void refine_to_target() {
    const bool by_triangles = given_.target_triangles != Parameters::kNoTarget;
    const std::size_t target = by_triangles ? given_.target_triangles : given_.target_vertices;
    const auto wanted = static_cast<std::size_t>(kFinerRatio * static_cast<double>(target));
    double& bound = parameters_.refinement[Criterion::distance];
    std::size_t count = 0;
    for (double next = kFirstDistanceVoxels * given_.voxel;
         next > kLastDistanceVoxels * given_.voxel && count < wanted; next *= kDistanceRatio) {
      bound = next;
      for_each_block(all(), [&](std::size_t n) { refine_block(run_, parameters_, blocks_[n]); });
      count = 0;
      for (const Block& block : blocks_) {
        const TriMesh& mesh = block.mesh.mesh;
        count += by_triangles ? mesh.faces.size() : mesh.points.size();
      }
    }
    // The seams, and larger blocks where one is refused.
    bool is_fresh = false;
    for (std::vector<std::size_t> todo = all(); !todo.empty(); is_fresh = true) {
      for_each_block(todo, [&](std::size_t n) {
        if (is_fresh) refine_block(run_, parameters_, blocks_[n]);
        make_seam(run_, blocks_[n]);
        blocks_[n].is_refined = true;
      });
      mesh_blocks(merge_refused());
      todo = all();
      std::erase_if(todo, [&](std::size_t n) { return blocks_[n].is_refined; });
    }
  }

  const Options options_;
  const Parameters& given_;
  Parameters parameters_;  // in blocks
  const BlockGrid grid_;
  const BlockRun run_;
  const std::vector<std::uint8_t> kept_;
  Report& report_;
  std::vector<Block> blocks_;
};

}  // namespace

WeldedMesh mesh_in_blocks(const Volume& volume, double kappa, const Options& options,
                          const Parameters& parameters, std::vector<std::uint8_t> kept,
                          Report& report) {
  return BlockMesher(volume, kappa, options, parameters, std::move(kept), report).run();
}

}  // namespace deliso
