// SPDX-License-Identifier: MIT
#include "contour/plain_seams.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/sorted_list.h"
#include "contour/crossed_voxels.h"
#include "embedding/triangle_pair.h"

namespace deliso {
namespace {

// Lifts that are tried, in voxels: from kPerturbationVoxels on, each a tenth of the one before,
// down to this one. T's vertices next to a face are as far from it as kCrossingMargin of a small
// cell.
constexpr double kLeastLiftVoxels = 5e-14, kLiftStep = 0.1;

// True if p lies on an edge of the grid: at a sample's place along two axes or more.
bool is_on_grid_edge(const Vec3& p, const Grid& grid) {
  int on_planes = 0;
  for (int axis = 0; axis < 3; ++axis) on_planes += grid.is_on_plane(p, axis);
  return on_planes >= 2;
}

// The vertices of a polyline of T in an inner face, between two crossings of grid edges.
struct Polyline {
  std::uint64_t voxel;  // voxel_number()
  BoxFace face;
  std::vector<ContourId> vertices;
};

// Takes the polylines of all loops out of the boundary, and closes the gaps to the segments.
std::vector<Polyline> close_gaps(ContourMesh& contour, const Volume& block) {
  std::vector<Polyline> polylines;
  for (std::size_t l = 0; l < contour.boundary.size(); ++l) {
    const BoundaryLoop loop = std::exchange(contour.boundary.loops[l], {});
    const std::vector<ContourId> all = std::exchange(contour.boundary.vertices[l], {});
    const auto vertex = [&](std::size_t k) { return all[k % all.size()]; };
    const auto goes = [&](std::size_t k) {
      return (block.inner_faces() & contour.box_faces[vertex(k)]) != 0 &&
             !is_on_grid_edge(contour.points[vertex(k)], block);
    };
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (goes(k)) continue;
      const ContourId from = vertex(k);
      contour.boundary.loops[l].push_back(loop[k]);
      contour.boundary.vertices[l].push_back(from);
      Polyline polyline{0, loop[k].face, {}};
      const std::size_t first = contour.triangles.size();
      std::size_t end = k + 1;
      // It runs along edges of triangles; these run along the other way.
      for (; goes(end); ++end) {
        contour.triangles.push_back({vertex(end + 1), vertex(end), from});
        polyline.vertices.push_back(vertex(end));
      }
      if (polyline.vertices.empty()) continue;
      const Vec3 middle = 0.5 * (contour.points[from] + contour.points[vertex(end)]);
      polyline.voxel = voxel_number(block.dims(), block.voxel_at(middle));
      contour.crowded.push_back({polyline.voxel, first, contour.triangles.size()});
      polylines.push_back(std::move(polyline));
    }
  }
  std::ranges::stable_sort(contour.crowded, {}, &ContourMesh::VoxelTriangles::voxel);
  for (const Polyline& polyline : polylines) {
    for (const ContourId v : polyline.vertices) contour.box_faces[v] = 0;
  }
  return polylines;
}

// Puts the polyline into the block, at this distance from its face.
void lift(const Polyline& polyline, double distance, ContourMesh& contour, const Box3& box) {
  const int axis = axis_of(polyline.face);
  const bool is_high = (polyline.face & 1) != 0;
  for (const ContourId v : polyline.vertices) {
    contour.points[v][axis] = is_high ? box.hi[axis] - distance : box.lo[axis] + distance;
  }
}

}  // namespace

void make_seams_plain(ContourMesh& contour, const Volume& block) {
  if (block.inner_faces() == 0 || contour.split_voxels == 0) return;
  const std::vector<Polyline> polylines = close_gaps(contour, block);
  std::vector<std::uint64_t> crossed;
  crossed.reserve(polylines.size());
  for (const Polyline& polyline : polylines) crossed.push_back(polyline.voxel);
  sort_unique(crossed);
  // No rounding brings a lifted vertex back onto the face.
  const double rounding = std::numeric_limits<double>::epsilon() * sum_of_sizes(block.box().hi);
  const double least = std::max(kLeastLiftVoxels * block.least_voxel(), rounding);
  for (double distance = kPerturbationVoxels * block.least_voxel();
       distance > least && !crossed.empty(); distance *= kLiftStep) {
    for (const Polyline& polyline : polylines) {
      if (std::ranges::binary_search(crossed, polyline.voxel)) {
        lift(polyline, distance, contour, block.box());
      }
    }
    crossed = crossed_voxels(contour, crossed);
  }
  const std::vector<std::uint64_t> asked = united(contour.crossed_voxels, crossed);
  if (!asked.empty()) contour.crossed_voxels = crossed_voxels(contour, asked);
}

}  // namespace deliso
