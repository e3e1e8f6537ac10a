// SPDX-License-Identifier: MIT
// The walls of a skin by edge: which meet at an edge, which have three given corners. A wall that
// is cut up has its parts in its place, and each knows which of the skin's it is part of.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <span>
#include <vector>

#include "more/solids/skin.h"

namespace deliso {

using WallId = Id<struct WallTag>;

class WallTable {
 public:
  explicit WallTable(std::span<const Wall> walls) {
    for (const Wall& wall : walls) add(wall, WallId(walls_.size()));
  }

  std::size_t size() const { return walls_.size(); }
  bool is_live(WallId w) const { return walls_[w].wall.v[0] != kNoId; }
  const Wall& operator[](WallId w) const { return walls_[w].wall; }

  // The wall that was given of which w is part.
  WallId whole(WallId w) const { return walls_[w].whole; }

  WallId add(const Wall& wall, WallId whole) {
    const WallId w(walls_.size());
    walls_.push_back({wall, whole});
    for (VertexId v : wall.v) {
      if (at_vertex_.size() <= v) at_vertex_.resize(v + 1);
      at_vertex_[v].push_back(w);
    }
    return w;
  }
  void remove(WallId w) {
    for (VertexId v : walls_[w].wall.v) std::erase(at_vertex_[v], w);
    walls_[w].wall.v[0] = kNoId;
  }
  // Puts two walls in the place of w: x in the place of one end of its edge a b, and of the other.
  std::array<WallId, 2> cut(WallId w, VertexId a, VertexId b, VertexId x) {
    Wall first = walls_[w].wall, second = first;
    const WallId whole = walls_[w].whole;
    remove(w);
    std::ranges::replace(first.v, a, x);
    std::ranges::replace(second.v, b, x);
    return {add(first, whole), add(second, whole)};
  }

  bool has_edge(VertexId a, VertexId b) const {
    return a < at_vertex_.size() &&
           std::ranges::any_of(at_vertex_[a], [&](WallId w) { return has(w, b); });
  }
  std::vector<WallId> at_edge(VertexId a, VertexId b) const {
    std::vector<WallId> walls;
    if (a >= at_vertex_.size()) return walls;
    std::ranges::copy_if(at_vertex_[a], std::back_inserter(walls),
                         [&](WallId w) { return has(w, b); });
    return walls;
  }

 private:
  struct Entry {
    Wall wall;
    WallId whole;
  };
  bool has(WallId w, VertexId v) const {
    const auto& corners = walls_[w].wall.v;
    return corners[0] == v || corners[1] == v || corners[2] == v;
  }

  IdArray<WallId, Entry> walls_;
  IdArray<VertexId, std::vector<WallId>> at_vertex_;
};

}  // namespace deliso
