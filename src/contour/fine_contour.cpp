// SPDX-License-Identifier: MIT
#include "contour/fine_contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/sorted_list.h"
#include "contour/crossed_voxels.h"
#include "contour/split_voxels.h"
#include "embedding/triangle_pair.h"
#include "mesh/first_at_place.h"

namespace deliso {
namespace {

// Bounds on cells along an axis and in a voxel: very unequal spacings would give any number.
constexpr int kMaxCellsAlongAxis = 32, kMaxCellsPerVoxel = 32768;
// Bound on the size of T in cells: kMaxGrowth times the plain one, plus some vertices for small
// volumes.
constexpr double kMaxGrowth = 4, kExtraVertices = 5e5;
// Cells per side that are tried in turn where triangles cross. Few pairs have a common divisor, so
// what lies on a plane between cells once lies well within a cell the next time. Each is a pass
// over the volume.
constexpr std::array kCellsPerSide{2, 5, 11, 15, 31};

// The length of a cell of a long voxel, in its shortest sides. Eight volumes of noise of 1:1:10,
// over a limit: 1.6 % of the facets; with 4, 2.6 %; with 1.5, 1.3 % and 8 % more vertices.
constexpr double kLongCellSides = 2;

// Returns how many cells to cut a voxel into: of about the side `cell`, or larger, up to
// `coarsest`, if those are too many.
Index3 cells_of(Vec3 spacing, double cell, double coarsest, std::size_t voxels,
                std::size_t plain_vertices) {
  const auto divided = [&](double side) {
    Index3 n;
    for (int axis = 0; axis < 3; ++axis) {
      n[axis] =
          std::clamp(static_cast<int>(std::lround(spacing[axis] / side)), 1, kMaxCellsAlongAxis);
    }
    return n;
  };
  const double limit = kMaxGrowth * static_cast<double>(plain_vertices) + kExtraVertices;
  // A voxel in cells holds about two vertices for every cell of one layer.
  const auto expected = [&](Index3 n) {
    return 2.0 / 3.0 * (n.i * n.j + n.j * n.k + n.k * n.i) * static_cast<double>(voxels);
  };
  const auto too_many = [&](Index3 n) {
    return n.i * n.j * n.k > kMaxCellsPerVoxel || expected(n) > limit;
  };
  while (cell < coarsest && too_many(divided(cell))) cell *= 1.25;
  return divided(std::min(cell, coarsest));
}

// Returns these voxels and their neighbors across faces; ascending.
std::vector<std::uint64_t> with_neighbors(const std::vector<std::uint64_t>& voxels, Index3 dims) {
  std::vector<std::uint64_t> out = voxels;
  for (const std::uint64_t voxel : voxels) {
    for (int f = 0; f < 6; ++f) {
      out.push_back(voxel_number(dims, voxel_across(numbered_voxel(dims, voxel), f)));
    }
  }
  sort_unique(out);
  return out;
}

// Moves each vertex at the place of an earlier one along T, towards the mean of its neighbors, by
// `perturbation`. Where samples of a voxel differ by many orders of magnitude, points of several
// cells round to one place. Facets there would have no area. None was found on the box in tests.
// Returns true if a vertex was moved.
bool perturb_coincident(ContourMesh& contour, double perturbation) {
  bool any = false;
  const std::vector<VertexId> first = first_at_place(contour.points);
  for (ContourId v = 0; v < first.size(); ++v) {
    if (first[v].number() == v.number()) continue;
    Vec3 along;
    for (const ContourTriangle& t : contour.triangles) {
      if (!has_corner(t, v)) continue;
      for (const ContourId u : t) along = along + (contour.points[u] - contour.points[v]);
    }
    const double size = length(along);
    if (contour.on_boundary(v) || !(size > 0)) continue;
    contour.points[v] = contour.points[v] + (perturbation / size) * along;
    any = true;
  }
  return any;
}

}  // namespace

Index3 cells_of_long_voxels(const Vec3& spacing) {
  const double side = kLongCellSides * std::min({spacing.x, spacing.y, spacing.z});
  Index3 cells;
  for (int axis = 0; axis < 3; ++axis) {
    const double number = std::round(spacing[axis] / side);
    cells[axis] = static_cast<int>(std::clamp<double>(number, 1, kMaxCellsAlongAxis));
  }
  return cells;
}

ContourMesh fine_contour(ContourMesh&& begun, const Volume& volume, double kappa, Index3 cells) {
  const Vec3 spacing = volume.spacing(), least = volume.least_spacing();
  const double shortest = std::min({spacing.x, spacing.y, spacing.z});
  const std::size_t vertices = begun.points.size();
  ContourSplit split;
  split.usual = cells;
  ContourMesh contour = std::move(begun);
  for (std::size_t trial = 0; trial < kCellsPerSide.size();) {
    // After the first pass only split voxels and their neighbors have new triangles.
    const std::vector<std::uint64_t> changed = with_neighbors(split.voxels, volume.dims());
    std::vector<std::uint64_t> crossed = crossed_voxels(contour, changed);
    if (crossed.empty()) break;
    std::vector<std::uint64_t> voxels = united(split.voxels, crossed);
    if (voxels.size() == split.voxels.size() && ++trial == kCellsPerSide.size()) {
      contour.crossed_voxels = std::move(crossed);
      break;
    }
    split.voxels = std::move(voxels);
    split.factor = cells_of(spacing, shortest / kCellsPerSide[trial], shortest / 2,
                            split.voxels.size(), vertices);
    contour = build_contour(volume, kappa, split);
  }
  if (contour.split_voxels > 0 &&
      perturb_coincident(contour, kPerturbationVoxels * std::min({least.x, least.y, least.z}))) {
    contour.crossed_voxels = crossed_voxels(contour, {});
  }
  return contour;
}

}  // namespace deliso
