// SPDX-License-Identifier: MIT
// A hash of points by place. Cells are numbered from the origin along each axis. Those of a row are
// adjacent in one table, into which all cells are wrapped: what is found may be of other cells too.
// Unlike BoxGrid, whose boxes come and go, it counts its work: a hostile mesh could make that
// unbounded.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/box3.h"

namespace deliso {

struct NumberedPoint {
  Vec3 at;
  std::uint32_t number;  // the caller's
};

class PointGrid {
 public:
  // Copies the points. `side`: of a cell.
  PointGrid(std::span<const NumberedPoint> points, double side);

  double side() const { return side_; }
  // Calls visit(point) for all points of the box and some others, perhaps more than once, until it
  // returns false. Each row of cells and each point adds one to `looked_at`.
  template <class Visit>
  void for_each_near(const Box3& box, std::size_t& looked_at, Visit&& visit) const;

 private:
  // Returns the cell's number along an axis. Places beyond 2^30 cells share the last one.
  std::int32_t cell(double place) const {
    return static_cast<std::int32_t>(std::clamp(std::floor(place * per_side_), -0x1p30, 0x1p30));
  }
  std::uint32_t list(std::int32_t i, std::int32_t j, std::int32_t k) const {
    return (static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(j) * 0x9e3779b1u +
            static_cast<std::uint32_t>(k) * 0x85ebca77u) &
           mask_;
  }

  double side_, per_side_;
  std::uint32_t mask_;
  std::vector<std::uint32_t> begin_;  // of each list in `points_`, and the end
  std::vector<NumberedPoint> points_;
};

template <class Visit>
void PointGrid::for_each_near(const Box3& box, std::size_t& looked_at, Visit&& visit) const {
  const auto all_in = [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      ++looked_at;
      if (!visit(points_[n])) return false;
    }
    return true;
  };
  std::array<std::int32_t, 3> lo, hi;
  double cells = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lo[axis] = cell(box.lo[static_cast<int>(axis)]);
    hi[axis] = cell(box.hi[static_cast<int>(axis)]);
    cells *= static_cast<double>(hi[axis]) - lo[axis] + 1;
  }
  if (cells >= static_cast<double>(points_.size())) {
    all_in(0, points_.size());
    return;
  }
  for (std::int32_t k = lo[2]; k <= hi[2]; ++k) {
    for (std::int32_t j = lo[1]; j <= hi[1]; ++j) {
      ++looked_at;
      const std::uint32_t first = list(lo[0], j, k), last = list(hi[0], j, k);
      const bool whole = first <= last
                             ? all_in(begin_[first], begin_[last + 1])
                             : all_in(begin_[first], points_.size()) && all_in(0, begin_[last + 1]);
      if (!whole) return;
    }
  }
}

}  // namespace deliso
