// SPDX-License-Identifier: MIT
#include "check/vertex_grids.h"

#include <bit>
#include <map>
#include <numeric>

#include "base/triangle.h"

namespace deliso {
namespace {

// Sizes of fewer triangles have no grid: a hostile mesh has triangles of every size.
constexpr std::size_t kLeastShare = 64;

}  // namespace

VertexGrids::VertexGrids(const CleanMesh& mesh) : mesh_(mesh) {
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (mesh.component[v] != kNoId) all_.push_back(v);
  }
  std::map<int, std::size_t> triangles_of;  // per power of the longest edge
  for (const auto& [a, b, c] : mesh.triangles) {
    const double longest2 = longest_edge2(mesh.points[a], mesh.points[b], mesh.points[c]);
    ++triangles_of[std::ilogb(longest2) / 2];
  }
  for (const auto& [power, triangles] : triangles_of) {
    if (kLeastShare * triangles >= mesh.triangles.size()) add_grid(power + 1);
  }
}

void VertexGrids::add_grid(int power) {
  Grid& grid = grids_.emplace_back();
  grid.power = power;
  grid.per_cell = std::ldexp(1.0, -power);
  const std::size_t lists = std::bit_ceil(all_.size());
  grid.mask = static_cast<std::uint32_t>(lists - 1);
  // A counting sort: begin[n + 1] advances from the first vertex of list n to the first of the
  // next.
  std::vector<std::uint32_t> list_of(all_.size());
  grid.begin.assign(lists + 2, 0);
  for (std::size_t n = 0; n < all_.size(); ++n) {
    const Vec3& p = mesh_.points[all_[n]];
    list_of[n] = grid.list(grid.cell(p.x), grid.cell(p.y), grid.cell(p.z));
    ++grid.begin[list_of[n] + 2];
  }
  std::partial_sum(grid.begin.begin(), grid.begin.end(), grid.begin.begin());
  grid.vertices.resize(all_.size());
  for (std::size_t n = 0; n < all_.size(); ++n) {
    grid.vertices[grid.begin[list_of[n] + 1]++] = all_[n];
  }
}

}  // namespace deliso
