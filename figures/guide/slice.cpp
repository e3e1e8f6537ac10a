// SPDX-License-Identifier: MIT
#include "guide/slice.h"

#include <numeric>

#include "base/check.h"
#include "contour/contour.h"
#include "contour/split_voxels.h"

namespace deliso::guide {
namespace {

Volume extruded(int columns, int rows, const std::function<double(double, double)>& f) {
  std::vector<double> samples;
  for (int layer = 0; layer < 2; ++layer) {
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) samples.push_back(f(i, j));
    }
  }
  return Volume::from_samples({columns, rows, 2}, {1, 1, Slice::kLayers}, samples);
}

}  // namespace

Slice::Slice(int columns, int rows, const std::function<double(double, double)>& f, int cells)
    : volume_(extruded(columns, rows, f)), tree_(volume_), surface_(volume_, 0) {
  ContourSplit split{{}, {cells, cells, 1}};
  split.voxels.resize(std::size_t(columns - 1) * (rows - 1));
  std::iota(split.voxels.begin(), split.voxels.end(), std::uint64_t{0});
  const ContourMesh contour = build_contour(volume_, 0, std::move(split));
  for (std::size_t c = 0; c < contour.boundary.size(); ++c) {
    std::vector<Vec2> loop;
    for (const VertexId v : contour.boundary.vertices[c]) {
      DELISO_CHECK((contour.box_faces[v] & 15u) == 0);
      loop.push_back({contour.points[v].x, contour.points[v].y});
    }
    // The same outline is on the upper layer.
    if (contour.points[contour.boundary.vertices[c][0]].z == 0) loops_.push_back(std::move(loop));
  }
}

std::vector<Vec2> Slice::hits(const Vec2& a, const Vec2& b) const {
  std::vector<Hit> found;
  SearchCounters counters;
  surface_.intersect({lifted(a), lifted(b)}, found, counters);
  std::vector<Vec2> points;
  for (const Hit& hit : found) points.push_back({hit.point.x, hit.point.y});
  return points;
}

}  // namespace deliso::guide
