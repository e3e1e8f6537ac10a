// SPDX-License-Identifier: MIT
// The edges of a skin's walls, by their ends. A cut edge has its parts in its place.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "more/solids/skin.h"

namespace deliso {

class WallEdges {
 public:
  // `given`: how many points the mesh has. Those that cut edges have larger numbers.
  WallEdges(std::span<const Wall> walls, std::size_t given) : next_(given), given_(given) {
    for (const Wall& wall : walls) {
      for (int k = 0; k < 3; ++k) {
        const VertexId a = wall.v[k], b = wall.v[(k + 1) % 3];
        if (has(a, b)) continue;
        next_[a].push_back(b);
        next_[b].push_back(a);
      }
    }
  }

  bool has(VertexId a, VertexId b) const {
    return a < next_.size() && std::ranges::find(next_[a], b) != next_[a].end();
  }
  bool has_any(VertexId a) const { return a < next_.size() && !next_[a].empty(); }
  void cut(VertexId a, VertexId b, VertexId x) {
    std::ranges::replace(next_[a], b, x);
    std::ranges::replace(next_[b], a, x);
    next_.resize(x + 1);
    next_[x] = {a, b};
  }

  // Returns the corners of a wall and the points that cut its edges, in their order around it.
  std::vector<VertexId> border(const std::array<VertexId, 3>& wall) const {
    std::vector<VertexId> border;
    for (int k = 0; k < 3; ++k) {
      border.push_back(wall[k]);
      if (!has(wall[k], wall[(k + 1) % 3])) append_cuts(wall[k], wall[(k + 1) % 3], border);
    }
    return border;
  }

 private:
  void append_cuts(VertexId a, VertexId b, std::vector<VertexId>& border) const {
    const std::size_t size = border.size();
    for (VertexId x : next_[a]) {
      for (VertexId from = a; x >= given_;) {
        border.push_back(x);
        const VertexId to = next_[x][next_[x][0] == from ? 1 : 0];
        from = x, x = to;
      }
      if (x == b) return;
      border.resize(size);
    }
  }

  IdArray<VertexId, std::vector<VertexId>> next_;
  std::size_t given_;
};

}  // namespace deliso
