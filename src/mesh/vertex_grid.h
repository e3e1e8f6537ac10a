// SPDX-License-Identifier: MIT
// Which vertices of a mesh are near a point: the vertices by cells of a grid over their box. A
// surface ball may hold vertices of another sheet, which no walk over the mesh comes to.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/box3.h"
#include "base/ids.h"
#include "base/vec3.h"

namespace deliso {

class VertexGrid {
 public:
  // Empty, for vertices below this number in this box; cells have sides of `cell`, or larger ones
  // where there would be many more of them than vertices. Points outside count as on the box.
  VertexGrid(const Box3& box, std::size_t vertices, double cell);

  void add(VertexId v, const Vec3& at);
  // pre: v was added at `at`.
  void remove(VertexId v, const Vec3& at);

  // Whether pred(v) holds for any of the vertices within `radius` of p, or a little further.
  template <class Predicate>
  bool any_near(const Vec3& p, double radius, Predicate&& pred) const;

 private:
  struct Cell {
    int i, j, k;
  };
  Cell cell_at(const Vec3& p) const;
  std::size_t number(const Cell& c) const {
    return (static_cast<std::size_t>(c.k) * static_cast<std::size_t>(dims_.j) +
            static_cast<std::size_t>(c.j)) *
               static_cast<std::size_t>(dims_.i) +
           static_cast<std::size_t>(c.i);
  }

  Vec3 lower_;
  double cell_;
  Cell dims_;
  std::vector<VertexId> first_;  // per cell, kNoId when it is empty
  std::vector<VertexId> next_;   // per vertex: the next one in its cell
};

template <class Predicate>
bool VertexGrid::any_near(const Vec3& p, double radius, Predicate&& pred) const {
  const Vec3 reach{radius, radius, radius};
  const Cell low = cell_at(p - reach), high = cell_at(p + reach);
  for (int k = low.k; k <= high.k; ++k) {
    for (int j = low.j; j <= high.j; ++j) {
      for (int i = low.i; i <= high.i; ++i) {
        for (VertexId v = first_[number({i, j, k})]; v != kNoId; v = next_[v]) {
          if (pred(v)) return true;
        }
      }
    }
  }
  return false;
}

}  // namespace deliso
