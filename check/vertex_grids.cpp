// SPDX-License-Identifier: MIT
#include "check/vertex_grids.h"

#include <cmath>
#include <map>

#include "base/triangle.h"

namespace deliso {
namespace {

// Sizes of a smaller share of the triangles have no grid: a hostile mesh has triangles of all
// sizes.
constexpr std::size_t kLeastShare = 64;

}  // namespace

VertexGrids::VertexGrids(const std::vector<Vec3>& points, std::span<const Triangle> triangles) {
  std::vector<std::uint8_t> is_corner(points.size(), 0);
  std::map<int, std::size_t> triangles_of;  // per power of two of the longest edge
  for (const auto& [a, b, c] : triangles) {
    is_corner[a] = is_corner[b] = is_corner[c] = 1;
    ++triangles_of[std::ilogb(longest_edge2(points[a], points[b], points[c])) / 2];
  }
  std::vector<NumberedPoint> vertices;
  for (VertexId v = 0; v < points.size(); ++v) {
    if (is_corner[v] != 0) vertices.push_back({points[v], v});
  }
  for (const auto& [power, count] : triangles_of) {
    if (kLeastShare * count >= triangles.size()) {
      grids_.emplace_back(vertices, std::ldexp(2.0, power));
    }
  }
}

}  // namespace deliso
