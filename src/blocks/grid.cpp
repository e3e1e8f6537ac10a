// SPDX-License-Identifier: MIT
#include "blocks/grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace deliso {

BlockGrid::BlockGrid(const Grid& volume, int side) : ends_count(true) {
  for (int axis = 0; axis < 3; ++axis) {
    const int voxels = volume.voxels()[axis], first = volume.first()[axis];
    const int parts = side > 0 ? std::max(1, (voxels + side / 2) / side) : 1;
    for (int n = 0; n <= parts; ++n) {
      planes[axis].push_back(first + static_cast<int>(std::int64_t{voxels} * n / parts));
    }
  }
}

int BlockGrid::room_at(int axis, std::size_t n) const {
  const std::vector<int>& at = planes[axis];
  int room = std::numeric_limits<int>::max();
  if (n > 1 || ends_count) room = at[n] - at[n - 1];
  if (n + 2 < at.size() || ends_count) room = std::min(room, at[n + 1] - at[n]);
  return room;
}

Index3 BlockGrid::cells() const {
  Index3 cells;
  for (int axis = 0; axis < 3; ++axis) cells[axis] = static_cast<int>(planes[axis].size()) - 1;
  return cells;
}

Index3 BlockGrid::cell_of(Index3 voxel) const {
  Index3 cell;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<int>& at = planes[axis];
    cell[axis] = static_cast<int>(std::ranges::upper_bound(at, voxel[axis]) - at.begin()) - 1;
  }
  return cell;
}

std::size_t BlockGrid::number_of(Index3 cell) const {
  const auto [nx, ny, nz] = cells();
  const int j = cell.k % 2 == 0 ? cell.j : ny - 1 - cell.j;
  const std::size_t row = std::size_t(ny) * cell.k + j;
  const int i = row % 2 == 0 ? cell.i : nx - 1 - cell.i;
  return row * nx + i;
}

std::vector<SampleBox> BlockGrid::boxes() const {
  const auto& [x, y, z] = planes;
  std::vector<SampleBox> boxes((x.size() - 1) * (y.size() - 1) * (z.size() - 1));
  for (std::size_t k = 0; k + 1 < z.size(); ++k) {
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      for (std::size_t i = 0; i + 1 < x.size(); ++i) {
        boxes[number_of({static_cast<int>(i), static_cast<int>(j), static_cast<int>(k)})] = {
            {x[i], y[j], z[k]}, {x[i + 1], y[j + 1], z[k + 1]}};
      }
    }
  }
  return boxes;
}

CellRun cells_of(PartChoice part, std::size_t cells) {
  const auto bound = [&](int n) { return cells * n / part.of; };
  return {bound(part.number - 1), bound(part.number)};
}

int usual_block_side(const Grid& volume) {
  const Index3 voxels = volume.voxels();
  return std::clamp(std::max({voxels.i, voxels.j, voxels.k}) / 5, 64, 128);
}

}  // namespace deliso
