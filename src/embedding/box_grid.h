// SPDX-License-Identifier: MIT
// A dynamic spatial hash of bounding boxes. One holds the facets of a mesh, another its vertices.
// They answer whether facets cross, whether a ball holds a vertex, and how far a point is from the
// mesh.
//
// There are grids of several sizes, each four times as coarse as the one before. A box is listed
// once: in the cell of its low corner, in a grid with cells at least as large as the box. The cells
// of a grid are wrapped into one table, those of a row side by side in memory. A list holds the
// boxes themselves, in single precision, in units of the smallest cell. Rounding keeps the order of
// coordinates, so boxes with a common point still meet. Four boxes are compared at once. So a query
// reads few and short runs of memory, and rejects nearly all boxes without access to the mesh.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/box3.h"
#include "mesh/tri_mesh.h"

namespace deliso {

class BoxGrid {
 public:
  using Id = std::uint32_t;  // the caller's; small numbers

  // A box in cells.
  struct Box {
    std::array<float, 3> lo, hi;
  };

  // A grid for points in `box`. `cell`: about as large as most of the boxes, or larger.
  BoxGrid(const Box3& box, double cell);
  // Makes room for so many elements, most of which are at most as large as a cell. pre: empty.
  void expect(std::size_t elements);

  // Returns the side of the smallest cells.
  double cell() const { return 1 / per_cell_; }

  // Returns the box of these points.
  Box box_of(std::span<const Vec3> points) const;
  Box box_of(const Vec3& point) const { return box_of(std::span(&point, 1)); }
  Box box_of(const std::vector<Vec3>& points, const Triangle& t) const;
  // Returns the box of a ball, rounded outwards. It may extend outside the grid's box.
  Box box_around(const Vec3& center, double radius) const;

  void add(Id id, const Box& box);
  void remove(Id id);

  // Returns true if pred(Element(id), its box) holds for any element whose box meets `query`. May
  // call pred twice for an element.
  template <class Element = FaceId, class Predicate>
  bool any(const Box& query, Predicate&& pred) const;

  static bool meet(const Box& a, const Box& b) {
    // No short cuts: six comparisons side by side are faster than six branches.
    int overlaps = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      overlaps &= static_cast<int>(a.lo[axis] <= b.hi[axis]);
      overlaps &= static_cast<int>(b.lo[axis] <= a.hi[axis]);
    }
    return overlaps != 0;
  }

 private:
  static constexpr Id kNoElement = 0xffffffff;
  static constexpr int kLevels = 12;
  static constexpr std::size_t kLanes = 4;
  using Four [[gnu::vector_size(kLanes * sizeof(float))]] = float;
  // An empty place has a box that meets none.
  struct Block {
    std::array<Four, 3> lo, hi;
    std::array<Id, kLanes> id;

    Box box(std::size_t i) const {
      return {{lo[0][i], lo[1][i], lo[2][i]}, {hi[0][i], hi[1][i], hi[2][i]}};
    }
    void put(std::size_t i, Id what, const Box& box);
  };
  // The elements of all cells that are wrapped into one list: the first `size` places of the `room`
  // blocks from blocks_[first] on.
  struct List {
    std::uint32_t first = 0, size = 0, room = 0;
    std::size_t end() const { return first + (size + kLanes - 1) / kLanes; }
  };
  // Where an element is listed, before wrapping, and in which grid.
  struct Place {
    std::uint32_t number = 0;
    std::int32_t level = -1;
  };
  // One of the grids.
  struct Level {
    std::vector<List> lists;  // none, or a power of two of them
    std::size_t size = 0;
    float extent = 0;  // of the largest box ever added
    List& list(std::uint32_t number) { return lists[number & (lists.size() - 1)]; }
    const List& list(std::uint32_t number) const { return lists[number & (lists.size() - 1)]; }
  };

  static float extent(const Box& box);
  static Place place_of(const Box& box);
  static float scale_of(int level) {
    return 1.0f / static_cast<float>(std::uint32_t{1} << 2 * level);
  }
  static std::uint32_t number_of(std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return i + j * 0x9e3779b1u + k * 0x85ebca77u;
  }
  void append(List& in, Id id, const Box& box);
  void grow(Level& level);

  Vec3 origin_;
  double per_cell_;
  float margin_;  // more than the rounding to single precision
  std::array<Level, kLevels> levels_;
  std::vector<Block> blocks_;
  std::array<std::vector<std::uint32_t>, 32> free_;  // runs of blocks, by the power of their size
  std::vector<Place> places_;                        // per id
};

template <class Element, class Predicate>
bool BoxGrid::any(const Box& query, Predicate&& pred) const {
  std::array<Four, 3> lo, hi;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lo[axis] = query.lo[axis] - Four{};
    hi[axis] = query.hi[axis] - Four{};
  }
  const auto look = [&](const List& in) {
    for (std::size_t b = in.first; b < in.end(); ++b) {
      const Block& block = blocks_[b];
      const auto overlaps = (block.lo[0] <= hi[0]) & (block.lo[1] <= hi[1]) &
                            (block.lo[2] <= hi[2]) & (block.hi[0] >= lo[0]) &
                            (block.hi[1] >= lo[1]) & (block.hi[2] >= lo[2]);
      const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(overlaps);
      if ((halves[0] | halves[1]) == 0) continue;
      for (std::size_t i = 0; i < kLanes; ++i) {
        if (overlaps[i] != 0 && pred(Element(block.id[i]), block.box(i))) return true;
      }
    }
    return false;
  };
  for (int n = 0; n < kLevels; ++n) {
    const Level& level = levels_[n];
    if (level.size == 0) continue;
    const float scale = scale_of(n);
    std::array<std::uint32_t, 3> low, high;
    std::size_t cells = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // Where the low corner of a box that meets the query may lie: up to a cell below zero. So one
      // is added before truncation, which rounds towards zero.
      const float first = (query.lo[axis] - level.extent) * scale;
      low[axis] = static_cast<std::uint32_t>(first + 1) - 1;
      high[axis] = static_cast<std::uint32_t>(query.hi[axis] * scale) + 1;
      cells *= high[axis] - low[axis];
    }
    if (cells > level.lists.size()) {  // scanning all lists is cheaper
      for (const List& in : level.lists) {
        if (look(in)) return true;
      }
      continue;
    }
    for (std::uint32_t k = low[2]; k != high[2]; ++k) {
      for (std::uint32_t j = low[1]; j != high[1]; ++j) {
        const std::uint32_t row = number_of(0, j, k);
        for (std::uint32_t i = low[0]; i != high[0]; ++i) {
          if (look(level.list(row + i))) return true;
        }
      }
    }
  }
  return false;
}

}  // namespace deliso
