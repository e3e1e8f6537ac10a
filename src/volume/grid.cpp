// SPDX-License-Identifier: MIT
#include "volume/grid.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace deliso {

void require_in_range(Index3 dims, const Vec3& spacing, const Frame& frame, std::string_view name) {
  for (int axis = 0; axis < 3; ++axis) {
    const double s = spacing[axis];
    const std::string_view along =
        std::string_view("xyz").substr(static_cast<std::size_t>(axis), 1);
    if (dims[axis] < 1) {
      throw InputError(name, ": has ", dims[axis], " samples along ", along);
    }
    if (!(s >= kSmallestSpacing && s * dims[axis] <= kLargestLength)) {
      throw InputError(name, ": spacing ", s, " along ", along, " is out of range (from ",
                       kSmallestSpacing, ", and to a box of ", kLargestLength, ")");
    }
  }
  if (!in_range(frame.origin)) {
    throw InputError(name, ": its origin is further than ", kLargestLength, " away");
  }
  for (const Vec3& axis : frame.axes) {
    constexpr double kTolerance = 1e-6;
    if (!(std::fabs(length(axis) - 1) <= kTolerance)) {
      throw InputError(name, ": an axis of its frame is no unit vector");
    }
  }
}

Grid Grid::as_block(Index3 first, Index3 whole) const {
  require_in_range(whole, spacing_, frame_, "volume");
  Grid block = *this;
  block.first_ = first;
  block.whole_ = whole;
  return block;
}

unsigned Grid::inner_faces() const {
  unsigned faces = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (first_[axis] > 0) faces |= 1u << (2 * axis);
    if (first_[axis] + dims_[axis] < whole_[axis]) faces |= 2u << (2 * axis);
  }
  return faces;
}

double Grid::voxel() const {
  const auto [x, y, z] = spacing_;
  if (x == y && y == z) return x;
  // Newton's method from above, the same bits on every machine, which cbrt() need not give.
  double side = std::max({x, y, z});
  for (;;) {
    const double next = (2 * side + x / side * y / side * z) / 3;
    if (!(next < side)) return side;
    side = next;
  }
}

Box3 Grid::box() const {
  return {position({0, 0, 0}), position(voxels())};
}

Index3 Grid::voxel_at(const Vec3& p) const {
  Index3 voxel;
  for (int axis = 0; axis < 3; ++axis) {
    const double u = in_samples(p, axis);
    const int last = std::max(dims_[axis] - 2, 0);
    voxel[axis] = u > 0 ? static_cast<int>(std::min(u, static_cast<double>(last))) : 0;
  }
  return voxel;
}

}  // namespace deliso
