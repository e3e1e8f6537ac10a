// SPDX-License-Identifier: MIT
#include "check/free_space.h"

#include <algorithm>
#include <cmath>

namespace deliso {
namespace {

constexpr std::uint64_t kMaxCells = 1u << 24;
constexpr int kMaxDistance = 8;     // cells
constexpr double kRounding = 1e-6;  // more than that of a Voronoi vertex, relative

// Sets each byte to the greatest of itself and those one step before and behind it. Across the ends
// of rows and layers that marks a few cells too many, which is safe.
void spread(std::vector<std::uint8_t>& cells, std::vector<std::uint8_t>& copy, std::size_t step) {
  copy = cells;
  const std::size_t size = cells.size();
  for (std::size_t n = step; n < size; ++n) cells[n] |= copy[n - step];
  for (std::size_t n = step; n < size; ++n) cells[n - step] |= copy[n];
}

}  // namespace

FreeSpace::FreeSpace(const VoxelComponents& voxels, const Volume& volume) : volume_(volume) {
  const Index3 count = volume.voxels();
  const auto cells = [&](int axis) { return static_cast<std::size_t>(count[axis] >> shift_) + 1; };
  while (cells(0) * cells(1) * cells(2) > kMaxCells) ++shift_;
  columns_ = cells(0);
  rows_ = cells(1);
  std::vector<std::uint8_t> near(columns_ * rows_ * cells(2), 0), copy;
  voxels.for_each_voxel(
      [&](Index3 v) { near[cell(v.i >> shift_, v.j >> shift_, v.k >> shift_)] = 1; });
  distance_.assign(near.size(), 0);
  for (int n = 0; n < kMaxDistance; ++n) {
    for (std::size_t c = 0; c < near.size(); ++c) {
      distance_[c] = static_cast<std::uint8_t>(distance_[c] + (near[c] ^ 1));
    }
    for (const std::size_t step : {std::size_t{1}, columns_, columns_ * rows_}) {
      spread(near, copy, step);
    }
  }
}

FreeSpace::Cube FreeSpace::around(const Vec3& p, double far) const {
  Cube cube;
  double outside = 0, room = 1 << shift_;  // from the box; in the cell
  Index3 c;
  for (int axis = 0; axis < 3; ++axis) {
    const double u = volume_.in_samples(p, axis), end = volume_.voxels()[axis];
    cube.middle[axis] = u;
    outside = std::max({outside, -u, u - end});
    c[axis] = static_cast<int>(std::clamp(u, 0.0, end)) >> shift_;
    const double within = u - (c[axis] << shift_);
    room = std::min({room, within, (1 << shift_) - within});
  }
  if (!std::isfinite(cube.middle.x + cube.middle.y + cube.middle.z)) return cube;
  const int distance = distance_[cell(c.i, c.j, c.k)];
  const double half = outside > 0 ? outside : distance == 0 ? 0 : room + ((distance - 1) << shift_);
  const Vec3 spacing = volume_.spacing();
  const double slack = kRounding * (1 + far / std::min({spacing.x, spacing.y, spacing.z}));
  cube.half = std::max((1 - kRounding) * half - slack, 0.0);
  return cube;
}

}  // namespace deliso
