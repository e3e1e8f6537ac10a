// SPDX-License-Identifier: MIT
#include "more/solids/recover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>
#include <span>
#include <utility>

#include "base/cancel.h"
#include "exact/predicates.h"
#include "more/solids/moves.h"
#include "more/solids/quality.h"
#include "more/solids/wall_table.h"

namespace deliso {
namespace {

// What the segment from a vertex to another one crosses first: the facet, or of it the edge from
// its corner number `edge` to the next.
struct Crossing {
  Facet facet;
  int edge = -1;
};

class Recovery {
 public:
  Recovery(CellMesh& mesh, std::span<const Wall> walls, int turn)
      : mesh_(mesh),
        walls_(walls),
        most_cuts_(1000 + walls.size() / 10),
        is_reversed_(turn % 2 == 1),
        share_cut_(turn < 2 ? 8 : 64) {}

  void run() {
    for (WallId w = 0; w < walls_.size(); ++w) {
      if (mark(w)) continue;
      ++counts_.missing_walls;
      require(w);
    }
    counts_.missing_edges = edges_.size();
    if (is_reversed_) {
      std::ranges::reverse(edges_);
      std::ranges::reverse(missing_);
    }
    while (!edges_.empty() || !missing_.empty()) {
      throw_if_canceled();
      if (counts_.cut_edges + counts_.cut_walls > most_cuts_) {
        counts_.lost += edges_.size() + missing_.size();
        return;
      }
      // What moves can do, as long as they do something; then a few cuts.
      if (recover_by_moves()) continue;
      for (std::size_t n = edges_.size() / share_cut_ + !edges_.empty(); n > 0; --n) {
        const auto [a, b] = edges_.front();
        edges_.pop_front();
        if (!recover_edge(a, b) && !cut_edge(a, b) && !cut_edge(b, a)) ++counts_.lost;
      }
      for (std::size_t n = edges_.empty() ? missing_.size() / share_cut_ + 1 : 0; n > 0; --n) {
        const WallId w = missing_.front();
        missing_.pop_front();
        if (!recover_wall(w) && !cut_wall(w)) ++counts_.lost;
      }
    }
  }

  std::vector<Wall> walls() const {
    std::vector<Wall> live;
    for (WallId w = 0; w < walls_.size(); ++w) {
      if (walls_.is_live(w)) live.push_back(walls_[w]);
    }
    return live;
  }
  const RecoveryCounts& counts() const { return counts_; }

 private:
  // Tries before an edge or a wall is cut.
  static constexpr int kMostTries = 24;
  static constexpr std::size_t kMostInZone = 24;
  // Parts of a wall are turned only if their areas are more than this share of it.
  static constexpr double kFlat = 1e-9;

  const Vec3& at(VertexId v) const { return mesh_.points[v]; }

  // Marks w as a wall of the mesh; returns whether it is a facet there.
  bool mark(WallId w) {
    const auto& [a, b, c] = walls_[w].v;
    const Facet f = mesh_.facet_with(a, b, c);
    if (f.cell == kNoId) return false;
    mesh_.set_wall(f);
    return true;
  }

  // Puts a wall and those of its edges that are missing on the lists.
  void require(WallId w) {
    const auto& v = walls_[w].v;
    for (int i = 0; i < 3; ++i) {
      const VertexId a = v[i], b = v[(i + 1) % 3];
      if (mesh_.cell_with(a, b) == kNoId) edges_.emplace_back(std::min(a, b), std::max(a, b));
    }
    missing_.push_back(w);
  }

  std::optional<Crossing> first_crossing(VertexId a, VertexId b) {
    mesh_.cells_at(a, star_);
    for (CellId c : star_) {
      const int i = corner_index(mesh_.corners(c), a);
      const auto v = mesh_.corners(Facet{c, i});
      int zeros = 0, on = -1;
      bool is_within = true;
      for (int k = 0; k < 3 && is_within; ++k) {
        const int side = orient3d(at(a), at(v[k]), at(v[(k + 1) % 3]), at(b));
        is_within = side >= 0;
        if (side == 0) ++zeros, on = k;
      }
      if (!is_within || zeros > 1) continue;
      return Crossing{{c, i}, on};
    }
    return std::nullopt;
  }

  bool remove_between(VertexId u, VertexId w, double floor) {
    if (walls_.has_edge(u, w)) return false;
    find_ring(mesh_, mesh_.cell_with(u, w), u, w, ring_);
    return !ring_.has_wall && remove_edge(mesh_, ring_, floor);
  }

  // Removes what the edge from a to b crosses first, or something beside it. Returns whether it
  // could.
  bool clear_first(VertexId a, VertexId b) {
    const auto crossing = first_crossing(a, b);
    if (!crossing) return false;
    const Facet f = crossing->facet;
    const auto v = mesh_.corners(f);
    if (crossing->edge >= 0)
      return remove_between(v[crossing->edge], v[(crossing->edge + 1) % 3], 0);
    if (remove_facet(mesh_, f, 0)) return true;
    for (int k = 0; k < 3; ++k) {
      if (remove_between(v[k], v[(k + 1) % 3], 0)) return true;
    }
    return false;
  }

  // An edge between two parts of one wall may as well be their other diagonal, if that is there.
  bool turn_edge(VertexId a, VertexId b) {
    const std::vector<WallId> parts = walls_.at_edge(a, b);
    if (parts.size() != 2 || walls_.whole(parts[0]) != walls_.whole(parts[1])) return false;
    std::array<VertexId, 2> other;
    for (int k = 0; k < 2; ++k) {
      for (VertexId v : walls_[parts[k]].v) {
        if (v != a && v != b) other[k] = v;
      }
    }
    const auto [u, v] = other;
    if (u == v || walls_.has_edge(u, v) || mesh_.cell_with(u, v) == kNoId) return false;
    const Vec3 normal = cross(at(b) - at(a), at(u) - at(a)), across = at(v) - at(u);
    const double of_a = dot(normal, cross(across, at(a) - at(u)));
    const double of_b = dot(normal, cross(across, at(b) - at(u)));
    const double least = kFlat * length2(normal);
    if (std::min(std::fabs(of_a), std::fabs(of_b)) <= least || (of_a > 0) == (of_b > 0))
      return false;
    std::array<Wall, 2> turned{walls_[parts[0]], walls_[parts[0]]};
    std::ranges::replace(turned[0].v, b, v);
    std::ranges::replace(turned[1].v, a, v);
    const WallId whole = walls_.whole(parts[0]);
    for (WallId w : parts) walls_.remove(w);
    for (const Wall& wall : turned) require(walls_.add(wall, whole));
    return true;
  }

  // Returns whether the edge is there now, or is no wall's any more.
  bool recover_edge(VertexId a, VertexId b) {
    for (int tries = 0; tries < kMostTries; ++tries) {
      if (!walls_.has_edge(a, b) || mesh_.cell_with(a, b) != kNoId || turn_edge(a, b)) return true;
      if (!clear_first(a, b) && !clear_first(b, a)) return false;
    }
    return false;
  }

  // Returns whether the lists are shorter now.
  bool recover_by_moves() {
    const std::size_t edges = edges_.size(), missing = missing_.size();
    for (std::size_t n = edges; n > 0; --n) {
      const auto [a, b] = edges_.front();
      edges_.pop_front();
      if (!recover_edge(a, b)) edges_.emplace_back(a, b);
    }
    for (std::size_t n = edges_.empty() ? missing_.size() : 0; n > 0; --n) {
      const WallId w = missing_.front();
      missing_.pop_front();
      if (!recover_wall(w)) missing_.push_back(w);
    }
    return edges_.size() < edges || missing_.size() < missing;
  }

  // Puts a vertex at p, which lies in or at the cell: in place of it, and of its neighbors as long
  // as a facet does not see p, or hardly does. Returns the vertex; kNoId where walls are in the
  // way.
  VertexId insert_at(const Vec3& p, CellId start) {
    for (double hardly : {1e-9, 1e-13, 0.}) {
      const VertexId x = insert_at(p, start, hardly);
      if (x != kNoId) return x;
    }
    return kNoId;
  }

  // Facets hardly see p if their cell has a shape that is not over `hardly`.
  VertexId insert_at(const Vec3& p, CellId start, double hardly) {
    std::vector<CellId> zone{start};
    for (std::size_t k = 0; k < zone.size(); ++k) {
      for (int i = 0; i < 4; ++i) {
        const CellId n = mesh_.neighbor(zone[k], i);
        if (std::ranges::find(zone, n) != zone.end() || sees(p, {zone[k], i}, hardly)) continue;
        if (n == kNoId || mesh_.is_wall({zone[k], i}) || zone.size() == kMostInZone) return kNoId;
        zone.push_back(n);
      }
    }
    return keeps_edges(zone) ? star_from(mesh_, p, zone, 0) : VertexId(kNoId);
  }

  bool sees(const Vec3& p, Facet f, double hardly) const {
    const auto [a, b, c] = mesh_.corners(f);
    return shape(at(c), at(b), at(a), p) > hardly;
  }

  // True if every wall's edge of the zone's cells is on the zone's boundary.
  bool keeps_edges(std::span<const CellId> zone) const {
    const auto for_each_edge = [](const Tetrahedron& v, int but, auto&& visit) {
      for (int i = 0; i < 4; ++i) {
        for (int k = i + 1; k < 4; ++k) {
          if (i != but && k != but) visit(v[i], v[k]);
        }
      }
    };
    std::vector<std::pair<VertexId, VertexId>> outer;
    for (CellId c : zone) {
      for (int i = 0; i < 4; ++i) {
        if (std::ranges::find(zone, mesh_.neighbor(c, i)) != zone.end()) continue;
        for_each_edge(mesh_.corners(c), i, [&](VertexId u, VertexId w) {
          outer.emplace_back(std::min(u, w), std::max(u, w));
        });
      }
    }
    bool kept = true;
    for (CellId c : zone) {
      for_each_edge(mesh_.corners(c), -1, [&](VertexId u, VertexId w) {
        if (walls_.has_edge(u, w) &&
            std::ranges::find(outer, std::pair<VertexId, VertexId>(std::minmax(u, w))) ==
                outer.end())
          kept = false;
      });
    }
    return kept;
  }

  // Cuts the edge from a to b where it first crosses a facet or an edge of cells.
  bool cut_edge(VertexId a, VertexId b) {
    const auto crossing = first_crossing(a, b);
    if (!crossing) return false;
    const Facet f = crossing->facet;
    const auto v = mesh_.corners(f);
    const double from_a = orient3d_value(at(v[0]), at(v[1]), at(v[2]), at(a));
    const double from_b = orient3d_value(at(v[0]), at(v[1]), at(v[2]), at(b));
    const Vec3 p = at(a) + from_a / (from_a - from_b) * (at(b) - at(a));
    const VertexId x = insert_at(p, f.cell);
    if (x == kNoId) return false;
    ++counts_.cut_edges;
    for (WallId w : walls_.at_edge(a, b)) {
      for (WallId part : walls_.cut(w, a, b, x)) require(part);
    }
    return true;
  }

  // True if the segment p q crosses the inside of the wall. Exact; false where it touches.
  bool crosses(const std::array<VertexId, 3>& wall, VertexId p, VertexId q) const {
    const auto& [a, b, c] = wall;
    const int side = orient3d(at(a), at(b), at(c), at(p));
    if (side * orient3d(at(a), at(b), at(c), at(q)) >= 0) return false;
    for (int k = 0; k < 3; ++k) {
      if (side * orient3d(at(wall[k]), at(wall[(k + 1) % 3]), at(q), at(p)) <= 0) return false;
    }
    return true;
  }

  // Finds the edge of cells that crosses the wall first beside its edge number k. Sets ring_ to it.
  bool find_crossing(const std::array<VertexId, 3>& wall, int k) {
    const VertexId a = wall[k], b = wall[(k + 1) % 3];
    const CellId cell = mesh_.cell_with(a, b);
    if (cell == kNoId) return false;
    find_ring(mesh_, cell, a, b, ring_);
    const std::size_t n = ring_.v.size();
    for (std::size_t i = 0; i + !ring_.is_closed < n; ++i) {
      const VertexId p = ring_.v[i], q = ring_.v[(i + 1) % n];
      if (!crosses(wall, p, q) || walls_.has_edge(p, q)) continue;
      find_ring(mesh_, ring_.cells[i], p, q, ring_);
      return true;
    }
    return false;
  }

  // Returns whether the wall is there now, or is none any more.
  bool recover_wall(WallId w) {
    if (!walls_.is_live(w)) return true;
    const std::array<VertexId, 3> v = walls_[w].v;
    const auto may_join = [&](VertexId p, VertexId q) { return !crosses(v, p, q); };
    for (int tries = 0; tries < kMostTries; ++tries) {
      if (mark(w)) return true;
      bool moved = false;
      for (int k = 0; k < 3 && !moved; ++k) {
        moved = find_crossing(v, k) && (remove_edge(mesh_, ring_, 0, may_join) || shrink_ring(v));
      }
      if (!moved) return false;
    }
    return false;
  }

  // Takes a cell out of the ring of an edge that crosses the wall, by the removal of a facet.
  bool shrink_ring(const std::array<VertexId, 3>& wall) {
    const Ring ring = ring_;
    for (std::size_t i = 0; i < ring.cells.size(); ++i) {
      // The facet between this cell and the next has the corners a, b and v[i + 1].
      const CellId c = ring.cells[i];
      const int index = corner_index(mesh_.corners(c), ring.v[i]);
      const Facet g = mesh_.mirror({c, index});
      if (g.cell == kNoId) continue;
      if (crosses(wall, ring.v[i], mesh_.corners(g.cell)[g.index])) continue;
      if (remove_facet(mesh_, {c, index}, 0)) return true;
    }
    return false;
  }

  bool cut_wall(WallId w) {
    const std::array<VertexId, 3> v = walls_[w].v;
    VertexId x = kNoId;
    for (int k = 0; k < 3 && x == kNoId; ++k) {
      if (!find_crossing(v, k)) continue;
      // From the wall's corners: so a wall in a plane of the axes is not left by rounding.
      std::array<double, 3> share;
      for (int n = 0; n < 3; ++n) {
        share[n] = orient3d_value(at(v[(n + 1) % 3]), at(v[(n + 2) % 3]), at(ring_.a), at(ring_.b));
      }
      const double all = share[0] + share[1] + share[2];
      const Vec3 p = at(v[0]) + share[1] / all * (at(v[1]) - at(v[0])) +
                     share[2] / all * (at(v[2]) - at(v[0]));
      x = insert_at(p, ring_.cells.front());
    }
    if (x == kNoId) return false;
    ++counts_.cut_walls;
    const Wall cut = walls_[w];
    const WallId whole = walls_.whole(w);
    walls_.remove(w);
    for (int k = 0; k < 3; ++k) {
      Wall part = cut;
      part.v[k] = x;
      require(walls_.add(part, whole));
    }
    return true;
  }

  CellMesh& mesh_;
  WallTable walls_;
  // Rounded edges that nearly touch may cut each other for ever: then another order is tried.
  std::size_t most_cuts_;
  bool is_reversed_;
  // Of the edges or walls that moves leave, one in as many is cut before moves are tried again.
  std::size_t share_cut_;
  RecoveryCounts counts_;
  std::deque<std::pair<VertexId, VertexId>> edges_;
  std::deque<WallId> missing_;
  std::vector<CellId> star_;
  Ring ring_;
};

}  // namespace

RecoveryCounts recover(CellMesh& mesh, std::vector<Wall>& walls, int turn) {
  Recovery recovery(mesh, walls, turn);
  recovery.run();
  walls = recovery.walls();
  return recovery.counts();
}

}  // namespace deliso
