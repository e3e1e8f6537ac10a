// SPDX-License-Identifier: MIT
// Who is near: the facets of a mesh that changes, by place. It serves every question of that kind:
// does a facet cross another, does a ball hold a vertex, how far is a point from the mesh.
//
// A facet is listed once, where the low corner of its box lies, in a grid whose cells are at least
// as large as the box: grids of all sizes, by powers of two, in one table that their cells are
// wrapped into, rows of cells side by side in memory. Boxes are kept in single precision, rounded
// outwards, in units of the smallest cell; so a look-up passes nearly all facets by without a look
// at the mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/box3.h"
#include "mesh/tri_mesh.h"

namespace deliso {

class FacetGrid {
 public:
  // In cells; holds what it is the box of.
  struct Box {
    std::array<float, 3> lo, hi;
  };

  // For points in `box`. `cell`: about as large as most facets.
  FacetGrid(const Box3& box, double cell);

  Box box_of(std::span<const Vec3> points) const;
  Box box_of(const std::vector<Vec3>& points, const Triangle& t) const;
  Box box_around(const Vec3& p, double radius) const;

  void add(FaceId f, const Box& box);
  void remove(FaceId f);
  const Box& box(FaceId f) const { return nodes_[f].box; }

  // Whether pred(f) holds for any facet whose box meets this one.
  template <class Predicate>
  bool any(const Box& query, Predicate&& pred) const;

  static bool meet(const Box& a, const Box& b) {
    // No short cuts: twelve comparisons that run side by side beat six branches.
    return (a.lo[0] <= b.hi[0]) & (b.lo[0] <= a.hi[0]) & (a.lo[1] <= b.hi[1]) &
           (b.lo[1] <= a.hi[1]) & (a.lo[2] <= b.hi[2]) & (b.lo[2] <= a.hi[2]);
  }

 private:
  static constexpr int kLevels = 24;
  static constexpr std::int32_t kUnlisted = -1;
  struct Node {
    Box box;
    FaceId next = kNoId;
    std::uint32_t place = 0;         // before it is wrapped
    std::int32_t level = kUnlisted;  // of the grid that it is in
  };

  static int level_of(const Box& box);
  static float scale_of(int level) { return 1.0f / static_cast<float>(std::uint32_t{1} << level); }
  static std::uint32_t place_of(int level, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return i + j * 0x9e3779b1u + k * 0x85ebca77u + static_cast<std::uint32_t>(level) * 0xc2b2ae3du;
  }
  void grow();

  Vec3 origin_;
  double per_cell_;
  float margin_;  // more than what rounding to single precision can do
  std::vector<FaceId> first_;  // a power of two of them
  std::vector<Node> nodes_;    // per facet
  std::array<std::uint32_t, kLevels> count_{};
  std::size_t size_ = 0;
};

template <class Predicate>
bool FacetGrid::any(const Box& query, Predicate&& pred) const {
  const auto mask = static_cast<std::uint32_t>(first_.size() - 1);
  for (int level = 0; level < kLevels; ++level) {
    if (count_[static_cast<std::size_t>(level)] == 0) continue;
    const float scale = scale_of(level);
    std::array<std::uint32_t, 3> low, high;
    std::size_t cells = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // The low corner of a box that meets the query lies up to a cell before it.
      low[axis] = static_cast<std::uint32_t>(query.lo[axis] * scale) - 1;
      high[axis] = static_cast<std::uint32_t>(query.hi[axis] * scale);
      cells *= high[axis] - low[axis] + 1;
    }
    if (cells > nodes_.size()) {  // then the facets are fewer
      for (FaceId f = 0; f < nodes_.size(); ++f) {
        if (nodes_[f].level != kUnlisted && meet(nodes_[f].box, query) && pred(f)) return true;
      }
      return false;
    }
    for (std::uint32_t k = low[2]; k != high[2] + 1; ++k) {
      for (std::uint32_t j = low[1]; j != high[1] + 1; ++j) {
        const std::uint32_t row = place_of(level, 0, j, k);
        for (std::uint32_t i = low[0]; i != high[0] + 1; ++i) {
          for (FaceId f = first_[(row + i) & mask]; f != kNoId; f = nodes_[f].next) {
            // Other cells may be wrapped into the same place.
            if (nodes_[f].place == row + i && meet(nodes_[f].box, query) && pred(f)) return true;
          }
        }
      }
    }
  }
  return false;
}

}  // namespace deliso
