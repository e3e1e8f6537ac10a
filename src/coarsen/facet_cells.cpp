// SPDX-License-Identifier: MIT
#include "coarsen/facet_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace deliso {
namespace {

// Cells, in the mean of the boxes' longest sides. Smaller ones list facets more often, larger ones
// compare more pairs.
constexpr float kCellSides = 1.5f;
// They are larger where facets would be listed in more cells in the mean: few large facets among
// many small ones.
constexpr std::uint32_t kMostCells = 16;
// And at least of this side, in that of one of as many squares as there are facets that cover three
// sides of the box of all. So where facets are tiny and far apart, a line along a side of the box
// meets some multiple of the square root of their number, and not a million cells. A surface that
// is large for its box has larger cells anyway.
constexpr float kLeastCell = 0.25f;

}  // namespace

FacetCells::Box FacetCells::box_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto four = [](const Vec3& p) {
    return Four{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 0};
  };
  const Four p = four(a), q = four(b), r = four(c);
  const Four lo = p < q ? p : q, hi = p < q ? q : p;
  return {lo < r ? lo : r, hi < r ? r : hi};
}

FacetCells::FacetCells(const TriMesh& mesh) {
  float sides = 0;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& t = mesh.faces[f].v;
    if (is_dead(mesh.faces[f])) continue;
    const Box box = box_of(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    if (facets_.empty()) all_ = box;
    all_ = {all_.lo < box.lo ? all_.lo : box.lo, all_.hi < box.hi ? box.hi : all_.hi};
    const Four size = box.hi - box.lo;
    sides += std::max({size[0], size[1], size[2]});
    facets_.push_back(f);
    boxes_.push_back(box);
  }
  if (facets_.empty()) return;
  // Along an axis there are up to 2^20 cells, which single precision can number.
  const Four size = all_.hi - all_.lo;
  const float least = std::max({size[0], size[1], size[2]}) * 0x1p-20f;
  const auto facets = static_cast<float>(facets_.size());
  const float square = (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]) / facets;
  per_cell_ = 1 / std::max({kCellSides * sides / facets, kLeastCell * std::sqrt(square), least,
                            std::numeric_limits<float>::min()});
  const auto cells = [&] {
    std::uint64_t sum = 0;
    for (const Box& box : boxes_) sum += cells_of(box);
    return sum;
  };
  while (cells() > kMostCells * facets_.size()) per_cell_ /= 2;
  const std::size_t lists = std::bit_ceil(2 * facets_.size());
  mask_ = lists - 1;
  first_.resize(lists + 1, 0);
  for (const Box& box : boxes_) {
    for_each_list(box, [&](std::size_t list) { ++first_[list]; });
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  // first_ goes back from the end of each list to where it begins.
  listed_.resize(first_.back());
  for (std::uint32_t n = 0; n < boxes_.size(); ++n) {
    for_each_list(boxes_[n], [&](std::size_t list) { listed_[--first_[list]] = n; });
  }
}

}  // namespace deliso
