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

VertexGrids::VertexGrids(const CleanMesh& mesh) {
  std::vector<NumberedPoint> vertices;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (mesh.component[v] != kNoId) vertices.push_back({mesh.points[v], v});
  }
  std::map<int, std::size_t> triangles_of;  // per power of two of the longest edge
  for (const auto& [a, b, c] : mesh.triangles) {
    const double longest2 = longest_edge2(mesh.points[a], mesh.points[b], mesh.points[c]);
    ++triangles_of[std::ilogb(longest2) / 2];
  }
  for (const auto& [power, triangles] : triangles_of) {
    if (kLeastShare * triangles >= mesh.triangles.size()) {
      grids_.emplace_back(vertices, std::ldexp(2.0, power));
    }
  }
}

}  // namespace deliso
