// SPDX-License-Identifier: MIT
// The walls of a skin by edge: which meet at an edge, which have three given corners. A wall that
// is cut up has its parts in its place, and each knows which of the skin's it is part of.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "more/solids/skin.h"

namespace deliso {

using WallId = Id<struct WallTag>;

class WallTable {
 public:
  explicit WallTable(std::span<const Wall> walls) {
    first_.reserve(2 * walls.size());
    for (const Wall& wall : walls) add(wall, WallId(walls_.size()));
  }

  std::size_t size() const { return walls_.size(); }
  bool is_live(WallId w) const { return walls_[w].wall.v[0] != kNoId; }
  const Wall& operator[](WallId w) const { return walls_[w].wall; }

  // The wall that was given of which w is part.
  WallId whole(WallId w) const { return walls_[w].whole; }

  WallId add(const Wall& wall, WallId whole) {
    const WallId w(walls_.size());
    walls_.push_back({wall, {}, whole});
    for (int i = 0; i < 3; ++i) {
      const auto [entry, is_new] = first_.try_emplace(edge(w, i), kNone);
      walls_[w].next[i] = std::exchange(entry->second, 3 * w.number() + i);
    }
    return w;
  }
  void remove(WallId w) {
    for (int i = 0; i < 3; ++i) {
      const auto entry = first_.find(edge(w, i));
      std::uint32_t* link = &entry->second;
      while (*link != 3 * w.number() + i) link = &walls_[WallId(*link / 3)].next[*link % 3];
      *link = walls_[w].next[i];
      if (entry->second == kNone) first_.erase(entry);
    }
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

  bool has_edge(VertexId a, VertexId b) const { return first_.contains(key(a, b)); }
  std::vector<WallId> at_edge(VertexId a, VertexId b) const {
    std::vector<WallId> walls;
    const auto entry = first_.find(key(a, b));
    if (entry == first_.end()) return walls;
    for (std::uint32_t link = entry->second; link != kNone;) {
      walls.emplace_back(link / 3);
      link = walls_[walls.back()].next[link % 3];
    }
    return walls;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  struct Entry {
    Wall wall;
    std::array<std::uint32_t, 3> next;  // 3 * wall + edge; edge i runs from v[i] to the next
    WallId whole;
  };
  static std::uint64_t key(VertexId a, VertexId b) {
    if (b < a) std::swap(a, b);
    return std::uint64_t{a} << 32 | b;
  }
  std::uint64_t edge(WallId w, int i) const {
    return key(walls_[w].wall.v[i], walls_[w].wall.v[(i + 1) % 3]);
  }

  IdArray<WallId, Entry> walls_;
  std::unordered_map<std::uint64_t, std::uint32_t> first_;
};

}  // namespace deliso
