// SPDX-License-Identifier: MIT
#include "more/cap/dissolve.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "base/check.h"
#include "base/disjoint_sets.h"
#include "contour/contour_stream.h"
#include "volume/sample_regions.h"

namespace deliso {
namespace {

// Unites the samples at a component's crossings, those on either side: one side of a component
// belongs to one region, even where no grid edge runs along it.
class SidesOfComponents final : public ContourSink {
 public:
  SidesOfComponents(const Volume& volume, DisjointSets& samples)
      : volume_(volume), samples_(samples) {}

  ContourId crossing(int, Index3, double, double, std::uint8_t) override { return kNoId; }
  void voxel(const VoxelPieces& p) override {
    for (int l = 0; l < p.loops.count; ++l) {
      if (p.label[l] >= sides.size()) sides.resize(p.label[l] + 1, {kNoId, kNoId});
      for (const std::uint8_t e : p.loops.edges(l)) {
        for (const int m : corners_of_edge(e)) {
          const std::uint32_t sample = number_of(volume_, corner_of(p.voxel, m));
          std::uint32_t& side = sides[p.label[l]][p.corners[m] >= 0];
          if (side == kNoId) side = sample;
          samples_.unite(side, sample);
        }
      }
    }
  }

  // Per label: a sample outside and one inside; kNoId if the label was replaced in its own voxel.
  std::vector<std::array<std::uint32_t, 2>> sides;

 private:
  const Volume& volume_;
  DisjointSets& samples_;
};

struct Region {
  std::uint64_t samples = 0;
  Index3 lo, hi;
  bool inside = false;
  std::vector<std::uint32_t> components = {};  // its boundary

  void add(const Region& other) {
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = samples == 0 ? other.lo[axis] : std::min(lo[axis], other.lo[axis]);
      hi[axis] = samples == 0 ? other.hi[axis] : std::max(hi[axis], other.hi[axis]);
    }
    samples += other.samples;
  }
  int side() const { return std::max({hi.i - lo.i, hi.j - lo.j, hi.k - lo.k}); }
};

}  // namespace

Dissolved dissolve_others(const Volume& volume, double kappa, const ComponentChoice& choice) {
  const Index3 dims = volume.dims();
  if (volume.sample_count() >= kNoId) {  // unreachable: in 4 GB
    throw InputError("--min-component and --largest with --cap are for less than 2^32 samples");
  }
  DisjointSets joined = regions_of_samples(volume, kappa);
  SidesOfComponents walk(volume, joined);
  WalkResult found = walk_contour(volume, kappa, walk);
  ContourSummary summary;
  const std::vector<std::uint32_t> component_of = found.components.finish(summary.components);

  const std::vector<std::uint32_t> region_of = joined.take_numbers();
  std::vector<Region> regions(1 + *std::max_element(region_of.begin(), region_of.end()));
  for_each_place({}, volume.voxels(), [&](Index3 p) {
    Region& region = regions[region_of[number_of(volume, p)]];
    region.add({1, p, p});
    region.inside = is_inside(volume, p, kappa);
  });
  std::vector<std::array<std::uint32_t, 2>> sides(summary.components.size());
  for (std::size_t label = 0; label < walk.sides.size(); ++label) {
    const auto& [outside, inside] = walk.sides[label];
    if (inside != kNoId) sides[component_of[label]] = {region_of[outside], region_of[inside]};
  }
  for (std::uint32_t c = 0; c < sides.size(); ++c) {
    for (const std::uint32_t side : sides[c]) regions[side].components.push_back(c);
  }

  Dissolved result;
  result.kept.assign(sides.size(), 1);
  std::vector<std::uint32_t> into(regions.size());
  std::iota(into.begin(), into.end(), 0);
  const auto current = [&](std::uint32_t r) {
    while (into[r] != r) r = into[r] = into[into[r]];
    return r;
  };
  using Leaf = std::pair<std::uint64_t, std::uint32_t>;  // sorted by samples
  std::set<Leaf> leaves;
  const std::vector<std::uint8_t> is_chosen = chosen_components(summary, choice);
  const auto enqueue_leaf = [&](std::uint32_t r) {
    Region& region = regions[r];
    std::erase_if(region.components, [&](std::uint32_t c) { return !result.kept[c]; });
    if (region.components.size() == 1) leaves.emplace(region.samples, r);
  };
  for (std::uint32_t r = 0; r < regions.size(); ++r) enqueue_leaf(r);
  while (!leaves.empty()) {
    const std::uint32_t r = leaves.begin()->second;
    leaves.erase(leaves.begin());
    const std::uint32_t c = regions[r].components[0];
    const bool is_small = choice.largest > 0 || regions[r].side() < choice.min_voxels;
    if (!result.kept[c] || is_chosen[c] || !is_small) continue;
    const std::uint32_t a = current(sides[c][0]), b = current(sides[c][1]), merged = a == r ? b : a;
    result.kept[c] = 0;
    into[r] = merged;
    leaves.erase({regions[merged].samples, merged});
    regions[merged].add(regions[r]);
    enqueue_leaf(merged);
  }
  for (unsigned m = 0; m < 8; ++m) {
    Index3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = (m >> axis & 1) != 0 ? dims[axis] - 1 : 0;
    result.corner_inside[m] = regions[current(region_of[number_of(volume, p)])].inside;
  }
  return result;
}

}  // namespace deliso
