// SPDX-License-Identifier: MIT
#include "check/point_grid.h"

#include <bit>
#include <numeric>

namespace deliso {

PointGrid::PointGrid(std::span<const NumberedPoint> points, double side)
    : side_(std::clamp(side, 1e-150, 1e150)), per_side_(1 / side_), points_(points.size()) {
  const std::size_t lists = std::bit_ceil(2 * points.size());
  mask_ = static_cast<std::uint32_t>(lists - 1);
  // A counting sort: begin_[n + 1] advances from the first point of list n to the first of the
  // next.
  begin_.assign(lists + 2, 0);
  std::vector<std::uint32_t> list_of;
  list_of.reserve(points.size());
  for (const auto& [p, number] : points) {
    list_of.push_back(list(cell(p.x), cell(p.y), cell(p.z)));
    ++begin_[list_of.back() + 2];
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  for (std::size_t n = 0; n < points.size(); ++n) points_[begin_[list_of[n] + 1]++] = points[n];
}

}  // namespace deliso
