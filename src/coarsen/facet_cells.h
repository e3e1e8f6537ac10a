// SPDX-License-Identifier: MIT
// The facets of a mesh by cells of a grid: each is listed in all cells that its bounding box meets.
// So facets whose boxes meet have a cell in common, and a line along an axis asks one row of cells.
// The cells are wrapped into one table. Boxes are in single precision: rounding keeps the order of
// coordinates, so boxes that meet still do.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "mesh/tri_mesh.h"

namespace deliso {

class FacetCells {
 public:
  // Lists the live facets.
  explicit FacetCells(const TriMesh& mesh);

  // Calls visit(f, g) for all two facets whose boxes meet, once or more.
  template <class Visit>
  void for_each_pair(Visit&& visit) const {
    // Half of the boxes meet, which no branch can guess: these are kept, then visited.
    std::vector<std::uint32_t> met;
    for (std::size_t list = 0; list + 1 < first_.size(); ++list) {
      met.resize(std::max<std::size_t>(met.size(), first_[list + 1] - first_[list]));
      for (std::uint32_t n = first_[list] + 1; n < first_[list + 1]; ++n) {
        const std::uint32_t a = listed_[n];
        const Box box = boxes_[a];
        std::size_t count = 0;
        for (std::uint32_t m = first_[list]; m < n; ++m) {
          const std::uint32_t b = met[count] = listed_[m];
          count +=
              static_cast<std::size_t>(meet(box, boxes_[b])) & static_cast<std::size_t>(a != b);
        }
        for (std::size_t k = 0; k < count; ++k) visit(facets_[a], facets_[met[k]]);
      }
    }
  }

  // Calls visit(f) for all facets whose boxes meet that of p and q, once or more.
  template <class Visit>
  void for_each_at(const Vec3& p, const Vec3& q, Visit&& visit) const {
    const Box box = common(box_of(p, q, q), all_);
    for_each_list(box, [&](std::size_t list) {
      for (std::uint32_t n = first_[list]; n < first_[list + 1]; ++n) {
        if (meet(box, boxes_[listed_[n]])) visit(facets_[listed_[n]]);
      }
    });
  }

  // Returns the side of a cell.
  double cell() const { return 1 / static_cast<double>(per_cell_); }

 private:
  using Four [[gnu::vector_size(4 * sizeof(float))]] = float;
  struct Box {
    Four lo, hi;  // x, y, z, 0
  };
  static Box box_of(const Vec3& a, const Vec3& b, const Vec3& c);
  static Box common(const Box& a, const Box& b) {
    return {a.lo > b.lo ? a.lo : b.lo, a.hi < b.hi ? a.hi : b.hi};
  }
  static bool meet(const Box& a, const Box& b) {
    const auto halves =
        std::bit_cast<std::array<std::uint64_t, 2>>((a.lo <= b.hi) & (b.lo <= a.hi));
    return (halves[0] & halves[1]) == ~std::uint64_t{0};
  }
  std::array<std::uint32_t, 3> cell_of(const Four& corner) const {
    const Four cell = (corner - all_.lo) * per_cell_;
    return {static_cast<std::uint32_t>(cell[0]), static_cast<std::uint32_t>(cell[1]),
            static_cast<std::uint32_t>(cell[2])};
  }
  // Returns the number of cells that the box meets. pre: it lies within `all_`.
  std::uint64_t cells_of(const Box& box) const {
    const auto low = cell_of(box.lo), high = cell_of(box.hi);
    std::uint64_t product = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) product *= high[axis] - low[axis] + 1;
    return product;
  }
  // Calls visit(list) for the cells that the box meets. pre: it lies within `all_`.
  template <class Visit>
  void for_each_list(const Box& box, Visit&& visit) const {
    const auto low = cell_of(box.lo), high = cell_of(box.hi);
    for (std::uint32_t k = low[2]; k <= high[2]; ++k) {
      for (std::uint32_t j = low[1]; j <= high[1]; ++j) {
        const std::uint32_t row = j * 0x9e3779b1u + k * 0x85ebca77u;
        for (std::uint32_t i = low[0]; i <= high[0]; ++i) visit((row + i) & mask_);
      }
    }
  }

  std::vector<FaceId> facets_;
  std::vector<Box> boxes_;             // of facets_
  Box all_{};                          // of all boxes
  float per_cell_ = 1;                 // cells in a unit of length
  std::size_t mask_ = 0;               // lists - 1
  std::vector<std::uint32_t> first_;   // per list: where it begins in listed_
  std::vector<std::uint32_t> listed_;  // indices of facets_
};

}  // namespace deliso
