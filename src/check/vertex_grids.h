// SPDX-License-Identifier: MIT
// Finds the vertices of a mesh by place. One hash of cells cannot serve small triangles beside
// large ones. So there are several grids of all vertices, with cells of the sizes that the mesh's
// triangles have. A search uses the grid whose cells fit its ball.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "check/point_grid.h"
#include "check/validity.h"

namespace deliso {

class VertexGrids {
 public:
  // Holds the vertices of the mesh's triangles.
  explicit VertexGrids(const CleanMesh& mesh);

  // Calls visit(vertex) for all vertices of a ball and some around it, perhaps more than once,
  // until it returns false. `looked_at` grows with the work.
  template <class Visit>
  void for_each_near(const Vec3& center, double radius, std::size_t& looked_at,
                     Visit&& visit) const {
    if (grids_.empty()) return;
    grid_for(radius).for_each_near(Box3{center, center}.grown(radius), looked_at, visit);
  }

 private:
  // Returns the grid of the least cells that are as large as the ball, or of the largest cells.
  const PointGrid& grid_for(double radius) const {
    const auto fits = [&](const PointGrid& grid) { return grid.side() >= 2 * radius; };
    const auto found = std::ranges::find_if(grids_, fits);
    return found != grids_.end() ? *found : grids_.back();
  }

  std::vector<PointGrid> grids_;  // by ascending side
};

}  // namespace deliso
