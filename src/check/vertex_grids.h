// SPDX-License-Identifier: MIT
// Finds the vertices of a mesh by place. One hash of cells cannot serve small triangles beside
// large ones. So there are several grids of all vertices, with cells of the sizes that the mesh's
// triangles have. A search uses the grid whose cells fit its ball.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "check/validity.h"

namespace deliso {

class VertexGrids {
 public:
  // Keeps a reference: the mesh must outlive the grids. Holds the vertices of its triangles.
  explicit VertexGrids(const CleanMesh& mesh);

  // Calls visit(vertex) for all vertices of a ball and some around it, perhaps more than once,
  // until it returns false. Each cell and vertex adds one to `looked_at`.
  template <class Visit>
  void for_each_near(const Vec3& center, double radius, std::size_t& looked_at,
                     Visit&& visit) const;

 private:
  // Cells are numbered from the origin along each axis. Those of a row are adjacent in one table,
  // into which all cells are wrapped.
  struct Grid {
    int power = 0;        // the side of a cell is 2^power
    double per_cell = 1;  // 2^-power
    std::uint32_t mask = 0;
    std::vector<std::uint32_t> begin;  // of the list of each cell in `vertices`, and the end
    std::vector<VertexId> vertices;

    // Returns the cell's number along an axis. Places beyond 2^30 cells share the last one.
    std::int32_t cell(double place) const {
      return static_cast<std::int32_t>(std::clamp(std::floor(place * per_cell), -0x1p30, 0x1p30));
    }
    // Returns the number of the cell's list.
    std::uint32_t list(std::int32_t i, std::int32_t j, std::int32_t k) const {
      return (static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(j) * 0x9e3779b1u +
              static_cast<std::uint32_t>(k) * 0x85ebca77u) &
             mask;
    }
    std::span<const VertexId> vertices_of(std::uint32_t first, std::uint32_t last) const {
      return {vertices.data() + begin[first], vertices.data() + begin[last + 1]};
    }
  };
  // Returns the grid of the least cells that are as large as the ball, or of the largest cells.
  const Grid& grid_for(double radius) const {
    const int power = std::ilogb(radius) + 2;
    const auto at_least = [&](const Grid& grid) { return grid.power >= power; };
    const auto found = std::find_if(grids_.begin(), grids_.end(), at_least);
    return found != grids_.end() ? *found : grids_.back();
  }
  void add_grid(int power);

  const CleanMesh& mesh_;
  std::vector<VertexId> all_;
  std::vector<Grid> grids_;  // by ascending power
};

template <class Visit>
void VertexGrids::for_each_near(const Vec3& center, double radius, std::size_t& looked_at,
                                Visit&& visit) const {
  if (grids_.empty()) return;
  const auto all_of = [&](std::span<const VertexId> vertices) {
    return std::ranges::all_of(vertices, [&](VertexId v) {
      ++looked_at;
      return visit(v);
    });
  };
  const Grid& grid = grid_for(radius);
  std::array<std::int32_t, 3> lo, hi;
  double cells = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lo[axis] = grid.cell(center[static_cast<int>(axis)] - radius);
    hi[axis] = grid.cell(center[static_cast<int>(axis)] + radius);
    cells *= static_cast<double>(hi[axis]) - lo[axis] + 1;
  }
  if (!(cells < static_cast<double>(all_.size()))) {
    all_of(all_);
    return;
  }
  for (std::int32_t k = lo[2]; k <= hi[2]; ++k) {
    for (std::int32_t j = lo[1]; j <= hi[1]; ++j) {
      ++looked_at;
      const std::uint32_t first = grid.list(lo[0], j, k), last = grid.list(hi[0], j, k);
      const bool whole = first <= last ? all_of(grid.vertices_of(first, last))
                                       : all_of(grid.vertices_of(first, grid.mask)) &&
                                             all_of(grid.vertices_of(0, last));
      if (!whole) return;
    }
  }
}

}  // namespace deliso
