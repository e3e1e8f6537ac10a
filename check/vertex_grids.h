// SPDX-License-Identifier: MIT
// Finds the vertices of a mesh by place. One hash of cells cannot serve small triangles beside
// large ones. So there are several grids of all vertices, with cells of the sizes that the mesh's
// triangles have. A search uses the grid whose cells fit its box.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "check/point_grid.h"
#include "mesh/tri_mesh.h"

namespace deliso {

class VertexGrids {
 public:
  // Holds the corners of these triangles.
  VertexGrids(const std::vector<Vec3>& points, std::span<const Triangle> triangles);

  // Calls visit(point) for all vertices in the box and some around it, perhaps more than once,
  // until it returns false. A point's number is the vertex. `looked_at` grows with the work.
  template <class Visit>
  void for_each_near(const Box3& box, std::size_t& looked_at, Visit&& visit) const {
    if (!grids_.empty()) grid_for(box.size()).for_each_near(box, looked_at, visit);
  }

 private:
  // Returns the grid of the least cells that are as large as the box, or of the largest cells.
  const PointGrid& grid_for(const Vec3& size) const {
    const double longest = std::max({size.x, size.y, size.z});
    const auto fits = [&](const PointGrid& grid) { return grid.side() >= longest; };
    const auto found = std::ranges::find_if(grids_, fits);
    return found != grids_.end() ? *found : grids_.back();
  }

  std::vector<PointGrid> grids_;  // by ascending side
};

}  // namespace deliso
