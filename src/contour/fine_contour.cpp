// SPDX-License-Identifier: MIT
#include "contour/fine_contour.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/sorted_list.h"
#include "delaunay/predicates.h"
#include "embedding/triangle_pair.h"
#include "embedding/triangle_tree.h"

namespace deliso {
namespace {

// Spacings far apart would give any number of cells: so many along an axis and in a voxel.
constexpr int kMostAlongAxis = 32, kMostCells = 4096;
// How large cells may make T: so many times the plain one, and a little more for small volumes.
constexpr double kGrowth = 4, kLittle = 5e5;
// How often a cell may be longer than wide.
constexpr double kLongest = 2;
// Where triangles cross, cells of so many to a side are tried: hardly any two with a common
// divisor, so that what lies on a plane between cells once lies well within one the next time. Few,
// since each is a pass over the volume.
constexpr std::array kParts{2, 5, 11, 15};

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
  // A voxel in cells holds about two vertices for every cell of one layer.
  const auto expected = [&](Index3 n) {
    return 2.0 / 3.0 * (n.i * n.j + n.j * n.k + n.k * n.i) * static_cast<double>(voxels);
  };
  const auto too_many = [&](Index3 n) {
    return n.i * n.j * n.k > kMostCells || expected(n) > limit;
  };
  while (cell < coarsest && too_many(divided(cell))) cell *= 1.25;
  return divided(std::min(cell, coarsest));
}

// The voxels, of those that is_asked() holds for, in which triangles of T cross; ascending.
// Triangles of two voxels do not: each lies in its own.
template <class IsAsked>
std::vector<std::uint64_t> crossed_voxels(const ContourMesh& contour, IsAsked&& is_asked) {
  std::vector<std::uint64_t> out;
  std::vector<Triangle> triangles;
  std::vector<Box3> boxes;
  for (const ContourMesh::VoxelTriangles& crowd : contour.crowded) {
    if (!is_asked(crowd.voxel)) continue;
    triangles.clear();
    boxes.clear();
    for (std::size_t t = crowd.first; t < crowd.end; ++t) {
      const Triangle& v = contour.triangles[t];
      const Vec3 &a = contour.points[v[0]], &b = contour.points[v[1]], &c = contour.points[v[2]];
      if (collinear(a, b, c)) continue;
      triangles.push_back(v);
      boxes.push_back(box_of(a, b, c));
    }
    const auto meets_earlier = [&](std::size_t g) {
      for (std::size_t f = 0; f < g; ++f) {
        if (TriangleTree::meet(boxes[f], boxes[g]) &&
            triangles_intersect(contour.points, triangles[f], triangles[g])) {
          return true;
        }
      }
      return false;
    };
    for (std::size_t g = 1; g < triangles.size(); ++g) {
      if (!meets_earlier(g)) continue;
      out.push_back(crowd.voxel);
      break;
    }
  }
  return out;
}

// These voxels and those across their faces; ascending.
std::vector<std::uint64_t> with_neighbors(const std::vector<std::uint64_t>& voxels, Index3 dims) {
  std::vector<std::uint64_t> out = voxels;
  for (const std::uint64_t voxel : voxels) {
    for (int f = 0; f < 6; ++f) {
      out.push_back(voxel_number(dims, beyond(numbered_voxel(dims, voxel), f)));
    }
  }
  sort_out(out);
  return out;
}

// The vertices that lie where an earlier one does. Where samples of a voxel differ by many orders
// of magnitude, points of several cells round to one place, and no site could tell them apart.
std::vector<VertexId> coincident(const std::vector<Vec3>& points) {
  std::vector<VertexId> found, table(std::bit_ceil(2 * points.size()), kNoId);
  for (VertexId v = 0; v < points.size(); ++v) {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(points[v][axis] + 0.0)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    std::size_t at = hash & (table.size() - 1);
    while (table[at] != kNoId && points[table[at]] != points[v]) at = (at + 1) & (table.size() - 1);
    if (table[at] != kNoId) found.push_back(v);
    table[at] = v;
  }
  return found;
}

// Moves each of these along T, towards the mean of its neighbors. On the box none was seen.
void part_coincident(ContourMesh& contour, double hair) {
  for (const VertexId v : coincident(contour.points)) {
    Vec3 along;
    for (const Triangle& t : contour.triangles) {
      if (!has_corner(t, v)) continue;
      for (const VertexId u : t) along = along + (contour.points[u] - contour.points[v]);
    }
    const double size = length(along);
    if (contour.on_boundary(v) || !(size > 0)) continue;
    contour.points[v] = contour.points[v] + (hair / size) * along;
  }
}

}  // namespace

ContourMesh fine_contour(ContourMesh&& plain, const Volume& volume, double kappa, int threads) {
  const Vec3 spacing = volume.spacing();
  const auto [shortest, longest] = std::minmax({spacing.x, spacing.y, spacing.z});
  const std::size_t vertices = plain.points.size();
  ContourSplit split;
  split.elsewhere = cells_of(spacing, std::min(kLongest * shortest, longest), longest,
                             plain.summary.active_voxels, vertices);
  ContourMesh contour = split.elsewhere == Index3{1, 1, 1}
                            ? std::move(plain)
                            : build_contour(volume, kappa, split, threads);
  for (std::size_t part = 0; part < kParts.size();) {
    // After the first look only what was cut, and what is beside it, has other triangles.
    const std::vector<std::uint64_t> changed = with_neighbors(split.voxels, volume.dims());
    const std::vector<std::uint64_t> crossed = crossed_voxels(contour, [&](std::uint64_t voxel) {
      return changed.empty() || std::binary_search(changed.begin(), changed.end(), voxel);
    });
    if (crossed.empty()) break;
    std::vector<std::uint64_t> voxels = united(split.voxels, crossed);
    if (voxels.size() == split.voxels.size() && ++part == kParts.size()) break;
    split.voxels = std::move(voxels);
    split.factor =
        cells_of(spacing, shortest / kParts[part], shortest / 2, split.voxels.size(), vertices);
    contour = build_contour(volume, kappa, split, threads);
  }
  if (contour.split_voxels > 0) part_coincident(contour, kHair * shortest);
  return contour;
}

}  // namespace deliso
