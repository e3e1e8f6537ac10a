// SPDX-License-Identifier: MIT
#include "more/solids/recover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "base/cancel.h"
#include "exact/predicates.h"
#include "more/solids/follow_wall.h"
#include "more/solids/moves.h"
#include "more/solids/quality.h"
#include "more/solids/wall_edges.h"

namespace deliso {
namespace {

// What the segment from a vertex to another one crosses first: the facet, or of it the edge from
// its corner number `edge` to the next.
struct Crossing {
  Facet facet;
  int edge = -1;
};

// The first two attempts make no flatter cells, which no solver can use: BABY at 112.2 had one of
// 4e-17.
constexpr double kNotFlat = 1e-7;

class Recovery {
 public:
  Recovery(CellMesh& mesh, std::vector<Wall>& walls, int turn)
      : mesh_(mesh),
        walls_(walls),
        wall_edges_(walls, mesh.points.size()),
        parts_(mesh),
        follower_(mesh, parts_),
        most_cuts_(1000 + walls.size()),
        is_reversed_(turn % 2 == 1),
        share_cut_(turn < 2 ? 8 : 64),
        floor_(turn < 2 ? kNotFlat : kPositive) {}

  RecoveryCounts run() {
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      const Corners& v = walls_[w].v;
      if (mark(v)) continue;
      ++counts_.missing_walls;
      missing_.push_back(w);
      for (int k = 0; k < 3; ++k) require(v[k], v[(k + 1) % 3]);
    }
    counts_.missing_edges = edges_.size();
    if (is_reversed_) {
      std::ranges::reverse(edges_);
      std::ranges::reverse(missing_);
    }
    // Edges and walls, one after another, that could not be cut.
    std::size_t in_vain = 0;
    while (missing() > 0) {
      throw_if_canceled();
      if (in_vain > missing() || cuts() > most_cuts_) {
        counts_.lost = missing();
        break;
      }
      // What moves can do, as long as they do something; then a few are cut.
      if (recover_by_moves()) continue;
      const std::size_t left = missing(), cut = cuts();
      const std::size_t tried = (edges_.empty() ? missing_.size() : edges_.size()) / share_cut_ + 1;
      for (std::size_t n = tried; n > 0 && missing() > 0; --n) {
        if (!edges_.empty()) {
          cut_first_edge();
          if (edges_.empty()) break;
        } else {
          const std::size_t w = missing_.front();
          missing_.pop_front();
          if (!recover_wall(w, true)) missing_.push_back(w);
        }
      }
      in_vain = missing() < left || cuts() > cut ? 0 : in_vain + tried;
    }
    std::erase_if(walls_, [](const Wall& wall) { return wall.v[0] == kNoId; });
    walls_.insert(walls_.end(), parts_.walls().begin(), parts_.walls().end());
    return counts_;
  }

 private:
  // Tries before an edge or a wall is cut.
  static constexpr std::size_t kMostTries = 24;
  static constexpr std::size_t kMostInZone = 24;
  // At once: then the wall is tried again after the others.
  static constexpr std::size_t kMostCutsOfWall = 200;

  const Vec3& at(VertexId v) const { return mesh_.points[v]; }
  std::size_t missing() const { return edges_.size() + missing_.size(); }
  std::size_t cuts() const { return counts_.cut_edges + counts_.cut_walls; }

  // Marks the facet as a wall of the mesh; returns whether it is there.
  bool mark(const Corners& v) {
    const Facet f = mesh_.facet_with(v[0], v[1], v[2]);
    if (f.cell == kNoId) return false;
    mesh_.set_wall(f);
    return true;
  }

  // Puts the edge on the list if it is missing.
  void require(VertexId a, VertexId b) {
    if (mesh_.cell_with(a, b) == kNoId) edges_.emplace_back(std::min(a, b), std::max(a, b));
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

  bool remove_between(VertexId u, VertexId w) {
    if (wall_edges_.has(u, w)) return false;
    find_ring(mesh_, mesh_.cell_with(u, w), u, w, ring_);
    return !ring_.has_wall && remove_edge(mesh_, ring_, floor_);
  }

  // Removes what the edge from a to b crosses first, or something beside it. Returns whether it
  // could.
  bool clear_first(VertexId a, VertexId b) {
    const auto crossing = first_crossing(a, b);
    if (!crossing) return false;
    const Facet f = crossing->facet;
    const auto v = mesh_.corners(f);
    if (crossing->edge >= 0) return remove_between(v[crossing->edge], v[(crossing->edge + 1) % 3]);
    if (remove_facet(mesh_, f, floor_)) return true;
    for (int k = 0; k < 3; ++k) {
      if (remove_between(v[k], v[(k + 1) % 3])) return true;
    }
    return false;
  }

  // Returns whether the edge is there now, or is no wall's any more.
  bool recover_edge(VertexId a, VertexId b) {
    for (std::size_t tries = 0; tries < kMostTries; ++tries) {
      if (!wall_edges_.has(a, b) || mesh_.cell_with(a, b) != kNoId) return true;
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
      const std::size_t w = missing_.front();
      missing_.pop_front();
      if (!recover_wall(w, false)) missing_.push_back(w);
    }
    return edges_.size() < edges || missing_.size() < missing;
  }

  // Puts a vertex at p, or where no cells let it be there a rounding beside: in place of the cells,
  // which it lies in or at, and of their neighbors as long as a facet does not see it, or hardly
  // does. Returns the vertex; kNoId where walls are in the way.
  VertexId insert_at(const Vec3& p, std::span<const CellId> start) {
    constexpr std::array<int, 3> kSteps{0, -1, 1};
    for (int n = 0; n < 27; ++n) {
      Vec3 q = p;
      for (int axis = 0, k = n; axis < 3; ++axis, k /= 3) {
        q[axis] += kSteps[k % 3] * 2 * kEpsilon * p[axis];
      }
      for (double hardly : {1e-9, 1e-13, kPositive}) {
        const VertexId x = insert_at(q, {start.begin(), start.end()}, hardly);
        if (x != kNoId) return x;
      }
    }
    return kNoId;
  }

  // Facets hardly see p if their cell has a shape that is not over `hardly`.
  VertexId insert_at(const Vec3& p, std::vector<CellId> zone, double hardly) {
    for (std::size_t k = 0; k < zone.size(); ++k) {
      for (int i = 0; i < 4; ++i) {
        const CellId n = mesh_.neighbor(zone[k], i);
        if (std::ranges::find(zone, n) != zone.end() || sees(p, {zone[k], i}, hardly)) continue;
        if (n == kNoId || mesh_.is_wall({zone[k], i}) || zone.size() == kMostInZone) return kNoId;
        zone.push_back(n);
      }
    }
    return keeps_edges(zone) ? star_from(mesh_, p, zone, floor_) : VertexId(kNoId);
  }

  bool sees(const Vec3& p, Facet f, double hardly) const {
    const auto [a, b, c] = mesh_.corners(f);
    return shape(at(c), at(b), at(a), p) > hardly;
  }

  // True if every wall's edge and corner of the zone's cells is on the zone's boundary.
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
      for (VertexId v : mesh_.corners(c)) {
        if (wall_edges_.has_any(v) && std::ranges::none_of(outer, [&](const auto& edge) {
              return edge.first == v || edge.second == v;
            }))
          return false;
      }
      for_each_edge(mesh_.corners(c), -1, [&](VertexId u, VertexId w) {
        if (wall_edges_.has(u, w) &&
            std::ranges::find(outer, std::pair<VertexId, VertexId>(std::minmax(u, w))) ==
                outer.end())
          kept = false;
      });
    }
    return kept;
  }

  // Cuts the edge from a to b where it first crosses a facet or an edge of cells. Returns the
  // vertex there or kNoId.
  VertexId cut_edge(VertexId a, VertexId b) {
    const auto crossing = first_crossing(a, b);
    if (!crossing) return kNoId;
    const Facet f = crossing->facet;
    const auto v = mesh_.corners(f);
    const double from_a = orient3d_value(at(v[0]), at(v[1]), at(v[2]), at(a));
    const double from_b = orient3d_value(at(v[0]), at(v[1]), at(v[2]), at(b));
    const Vec3 p = at(a) + from_a / (from_a - from_b) * (at(b) - at(a));
    // What is crossed must go, or rounding would leave it beside x.
    std::vector<CellId> crossed{f.cell, mesh_.mirror(f).cell};
    if (crossing->edge >= 0) {
      find_ring(mesh_, f.cell, v[crossing->edge], v[(crossing->edge + 1) % 3], ring_);
      crossed = ring_.cells;
    }
    const VertexId x = insert_at(p, crossed);
    if (x == kNoId) return x;
    ++counts_.cut_edges;
    wall_edges_.cut(a, b, x);
    require(a, x);
    return x;
  }

  // Cuts the first edge of the list until all of it is there, or puts what is left at the end.
  void cut_first_edge() {
    auto [a, b] = edges_.front();
    edges_.pop_front();
    for (std::size_t tries = 0; cuts() <= most_cuts_; ++tries) {
      // Moves may make a part cross more; a cut leaves one that crosses less.
      if (tries < kMostTries ? recover_edge(a, b) : mesh_.cell_with(a, b) != kNoId) return;
      VertexId x = cut_edge(a, b);
      if (x == kNoId) {
        std::swap(a, b);
        x = cut_edge(a, b);
      }
      if (x == kNoId) break;
      a = x;
    }
    edges_.emplace_back(a, b);
  }

  // Returns whether the wall is there now.
  bool recover_wall(std::size_t w, bool may_cut) {
    const Corners v = walls_[w].v;
    const std::vector<VertexId> border = wall_edges_.border(v);
    std::vector<VertexId> on = border;
    if (cuts_of_.contains(w)) on.insert(on.end(), cuts_of_[w].begin(), cuts_of_[w].end());
    const auto may_join = [&](VertexId p, VertexId q) { return !crosses(mesh_.points, v, p, q); };
    for (std::size_t tries = 0; tries < kMostTries + (may_cut ? kMostCutsOfWall : 0); ++tries) {
      if (follower_.follow(v, border, on)) {
        if (border.size() == 3 && follower_.facets().size() == 1) return mark(v);
        if (!follower_.fits(v)) return false;
        for (const Corners& facet : follower_.facets()) {
          parts_.add({facet, walls_[w].front, walls_[w].behind, walls_[w].kind});
        }
        walls_[w].v[0] = kNoId;
        return true;
      }
      const bool moved =
          tries < kMostTries && std::ranges::any_of(follower_.pierced(), [&](const Pierced& edge) {
            if (wall_edges_.has(edge.p, edge.q)) return false;
            find_ring(mesh_, edge.cell, edge.p, edge.q, ring_);
            return remove_edge(mesh_, ring_, floor_, may_join) || shrink_ring(v);
          });
      if (moved) continue;
      VertexId x = kNoId;
      for (std::size_t n = 0; may_cut && x == kNoId && n < follower_.pierced().size(); ++n) {
        x = cut_wall(v, follower_.pierced()[n]);
      }
      if (x == kNoId) return false;
      on.push_back(x);
      cuts_of_[w].push_back(x);
    }
    return false;
  }

  // Cuts the wall where the edge crosses it. Returns the vertex there or kNoId.
  VertexId cut_wall(const Corners& v, const Pierced& edge) {
    if (wall_edges_.has(edge.p, edge.q)) return kNoId;
    find_ring(mesh_, edge.cell, edge.p, edge.q, ring_);
    // From the wall's corners: so a wall in a plane of the axes is not left by rounding.
    std::array<double, 3> share;
    for (int n = 0; n < 3; ++n) {
      share[n] = orient3d_value(at(v[(n + 1) % 3]), at(v[(n + 2) % 3]), at(edge.p), at(edge.q));
    }
    const double all = share[0] + share[1] + share[2];
    const Vec3 p =
        at(v[0]) + share[1] / all * (at(v[1]) - at(v[0])) + share[2] / all * (at(v[2]) - at(v[0]));
    const VertexId x = insert_at(p, ring_.cells);
    counts_.cut_walls += x != kNoId;
    return x;
  }

  // Takes a cell out of the ring of an edge that crosses the wall, by the removal of a facet.
  bool shrink_ring(const Corners& wall) {
    const Ring ring = ring_;
    for (std::size_t i = 0; i < ring.cells.size(); ++i) {
      // The facet between this cell and the next has the corners a, b and v[i + 1].
      const CellId c = ring.cells[i];
      const int index = corner_index(mesh_.corners(c), ring.v[i]);
      const Facet g = mesh_.mirror({c, index});
      if (g.cell == kNoId) continue;
      if (crosses(mesh_.points, wall, ring.v[i], mesh_.corners(g.cell)[g.index])) continue;
      if (remove_facet(mesh_, {c, index}, floor_)) return true;
    }
    return false;
  }

  CellMesh& mesh_;
  std::vector<Wall>& walls_;
  WallEdges wall_edges_;
  WallParts parts_;
  WallFollower follower_;
  // Rounded edges that nearly touch may go on for ever: then another order is tried.
  std::size_t most_cuts_;
  bool is_reversed_;
  // Of the edges or walls that moves leave, one in as many is cut before moves are tried again.
  std::size_t share_cut_;
  const double floor_;  // of the shapes of new cells
  RecoveryCounts counts_;
  std::deque<std::pair<VertexId, VertexId>> edges_;
  std::deque<std::size_t> missing_;
  std::map<std::size_t, std::vector<VertexId>> cuts_of_;  // a wall, inside
  std::vector<CellId> star_;
  Ring ring_;
};

}  // namespace

RecoveryCounts recover(CellMesh& mesh, std::vector<Wall>& walls, int turn) {
  return Recovery(mesh, walls, turn).run();
}

}  // namespace deliso
