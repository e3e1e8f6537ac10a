// SPDX-License-Identifier: MIT
#include "cap/dissolve.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "base/check.h"
#include "base/disjoint_sets.h"

namespace deliso {
namespace {

template <class Visit>
void for_each_sample(Index3 dims, Visit&& visit) {
  Index3 p;
  for (p.k = 0; p.k < dims.k; ++p.k) {
    for (p.j = 0; p.j < dims.j; ++p.j) {
      for (p.i = 0; p.i < dims.i; ++p.i) visit(p);
    }
  }
}

// Returns the two samples of the grid edge that a vertex of T lies on. Nothing for other vertices,
// or if rounding put it on a sample.
std::optional<std::array<Index3, 2>> grid_edge(const Volume& volume, const Vec3& p) {
  std::array<Index3, 2> ends;
  int along = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double spacing = volume.spacing()[axis];
    const auto nearest = static_cast<int>(std::lround(p[axis] / spacing));
    ends[0][axis] = ends[1][axis] = nearest;
    if (p[axis] == nearest * spacing) continue;
    ++along;
    const int low = nearest - (p[axis] < nearest * spacing);
    ends[0][axis] = std::clamp(low, 0, volume.dims()[axis] - 2);
    ends[1][axis] = ends[0][axis] + 1;
  }
  return along == 1 ? std::optional(ends) : std::nullopt;
}

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

Dissolved dissolve_others(const ContourMesh& contour, const Volume& volume, double kappa,
                          const ComponentChoice& choice) {
  const Index3 dims = volume.dims();
  const auto number = [&](Index3 p) {
    return static_cast<std::uint32_t>(volume.index(p.i, p.j, p.k));
  };
  const auto is_inside = [&](Index3 p) { return volume.sample(p.i, p.j, p.k) >= kappa; };

  if (volume.sample_count() >= kNoId) {
    throw InputError("--min-component and --largest with --cap are for less than 2^32 samples");
  }
  DisjointSets joined(volume.sample_count());
  for_each_sample(dims, [&](Index3 p) {
    for (int axis = 0; axis < 3; ++axis) {
      Index3 q = p;
      if (--q[axis] >= 0 && is_inside(p) == is_inside(q)) joined.unite(number(q), number(p));
    }
  });
  // One side of a component belongs to one region, even where no grid edge runs along it.
  const std::vector<ContourComponent>& components = contour.summary.components;
  std::vector<std::array<std::uint32_t, 2>> sides(components.size(), {kNoId, kNoId});
  for (VertexId v = 0; v < contour.points.size(); ++v) {
    const auto ends = grid_edge(volume, contour.points[v]);
    if (!ends || is_inside((*ends)[0]) == is_inside((*ends)[1])) continue;
    for (const Index3 end : *ends) {
      std::uint32_t& side = sides[contour.component[v]][is_inside(end)];
      if (side == kNoId) side = number(end);
      joined.unite(side, number(end));
    }
  }

  const std::vector<std::uint32_t> region_of = joined.take_numbers();
  std::vector<Region> regions(1 + *std::max_element(region_of.begin(), region_of.end()));
  for_each_sample(dims, [&](Index3 p) {
    Region& region = regions[region_of[number(p)]];
    region.add({1, p, p});
    region.inside = is_inside(p);
  });
  for (std::uint32_t c = 0; c < components.size(); ++c) {
    const bool is_known = sides[c][0] != kNoId && sides[c][1] != kNoId;
    for (std::uint32_t& side : sides[c]) {
      if (side == kNoId) continue;
      side = region_of[side];
      // A component with an unknown side must stay: it counts as two.
      regions[side].components.insert(regions[side].components.end(), is_known ? 1 : 2, c);
    }
  }

  Dissolved result;
  result.kept.assign(components.size(), 1);
  std::vector<std::uint32_t> into(regions.size());
  std::iota(into.begin(), into.end(), 0);
  const auto current = [&](std::uint32_t r) {
    while (into[r] != r) r = into[r] = into[into[r]];
    return r;
  };
  using Leaf = std::pair<std::uint64_t, std::uint32_t>;  // sorted by samples
  std::set<Leaf> leaves;
  const std::vector<std::uint8_t> is_chosen = chosen_components(contour.summary, choice);
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
    result.corner_inside[m] = regions[current(region_of[number(p)])].inside;
  }
  return result;
}

}  // namespace deliso
