// SPDX-License-Identifier: MIT
#include "recover/cell_sizes.h"

#include <algorithm>
#include <cmath>

namespace deliso {
namespace {

// Spacings far apart would give any number of cells: so many along an axis and in a voxel.
constexpr int kMostAlongAxis = 32, kMostCells = 4096;
// How large a split may make T: so many times the plain one, and a little more for small volumes.
constexpr double kGrowth = 4, kLittle = 5e5;

// How often a cell may be longer than wide.
constexpr double kLongest = 2;

// Cells of about the side `cell`, or of up to `coarsest` where those would be too many.
Index3 cells_of(Vec3 spacing, double cell, double coarsest, std::size_t voxels,
                std::size_t plain_vertices) {
  const auto divided = [&](double side) {
    Index3 n;
    for (int axis = 0; axis < 3; ++axis) {
      n[axis] = std::clamp(static_cast<int>(std::lround(spacing[axis] / side)), 1, kMostAlongAxis);
    }
    return n;
  };
  const double limit = kGrowth * static_cast<double>(plain_vertices) + kLittle;
  // A split voxel holds about two vertices for every cell of one layer.
  const auto expected = [&](Index3 n) {
    return 2.0 / 3.0 * (n.i * n.j + n.j * n.k + n.k * n.i) * static_cast<double>(voxels);
  };
  const auto too_many = [&](Index3 n) {
    return n.i * n.j * n.k > kMostCells || expected(n) > limit;
  };
  while (cell < coarsest && too_many(divided(cell))) cell *= 1.25;
  return divided(std::min(cell, coarsest));
}

}  // namespace

Index3 cells_elsewhere(Vec3 spacing, std::size_t active, std::size_t plain_vertices) {
  const auto [shortest, longest] = std::minmax({spacing.x, spacing.y, spacing.z});
  return cells_of(spacing, std::min(kLongest * shortest, longest), longest, active, plain_vertices);
}

Index3 cells_at_trouble(Vec3 spacing, double r_min, std::size_t listed,
                        std::size_t plain_vertices) {
  // Two cells a side where nothing smaller matters: else the split would be none.
  const double coarsest = std::min({spacing.x, spacing.y, spacing.z}) / 2;
  return cells_of(spacing, std::min(r_min, coarsest), coarsest, listed, plain_vertices);
}

}  // namespace deliso
