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
#include "base/triangle.h"
#include "exact/predicates.h"
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

// An edge p q of cells that crosses a wall, and a cell at it.
struct Pierced {
  CellId cell;
  VertexId p, q;
};

using Corners = std::array<VertexId, 3>;

double largest_coordinate(const IdArray<VertexId, Vec3>& points) {
  double largest = 0;
  for (const Vec3& p : points) {
    largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  }
  return largest;
}

class Recovery {
 public:
  Recovery(CellMesh& mesh, std::vector<Wall>& walls, int turn)
      : mesh_(mesh),
        walls_(walls),
        wall_edges_(walls, mesh.points.size()),
        most_cuts_(1000 + walls.size()),
        largest_coordinate_(largest_coordinate(mesh.points)),
        is_reversed_(turn % 2 == 1),
        share_cut_(turn < 2 ? 8 : 64) {}

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
    walls_.insert(walls_.end(), parts_.begin(), parts_.end());
    return counts_;
  }

 private:
  // Tries before an edge or a wall is cut.
  static constexpr std::size_t kMostTries = 24;
  static constexpr std::size_t kMostInZone = 24;
  // At once. Of ten families of hard skins no wall that was recovered had more.
  static constexpr std::size_t kMostCutsOfWall = 200;
  // Of an area: times the largest coordinate and the wall's longest edge.
  static constexpr double kMostRounding = 4e-13;

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
    return !ring_.has_wall && remove_edge(mesh_, ring_, kPositive);
  }

  // Removes what the edge from a to b crosses first, or something beside it. Returns whether it
  // could.
  bool clear_first(VertexId a, VertexId b) {
    const auto crossing = first_crossing(a, b);
    if (!crossing) return false;
    const Facet f = crossing->facet;
    const auto v = mesh_.corners(f);
    if (crossing->edge >= 0) return remove_between(v[crossing->edge], v[(crossing->edge + 1) % 3]);
    if (remove_facet(mesh_, f, kPositive)) return true;
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
    return keeps_edges(zone) ? star_from(mesh_, p, zone, kPositive) : VertexId(kNoId);
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

  // True if the segment p q crosses the inside of the wall. Exact; false where it touches.
  bool crosses(const Corners& wall, VertexId p, VertexId q) const {
    const auto& [a, b, c] = wall;
    const int side = orient3d(at(a), at(b), at(c), at(p));
    if (side * orient3d(at(a), at(b), at(c), at(q)) >= 0) return false;
    for (int k = 0; k < 3; ++k) {
      if (side * orient3d(at(wall[k]), at(wall[(k + 1) % 3]), at(q), at(p)) <= 0) return false;
    }
    return true;
  }

  // True if the border goes from a to b.
  static bool follows(std::span<const VertexId> border, VertexId a, VertexId b) {
    for (std::size_t n = 0; n < border.size(); ++n) {
      if (border[n] == a) return border[(n + 1) % border.size()] == b;
    }
    return false;
  }

  // Follows the wall from its border `on` inwards, facet by facet: sets `facets_`, and `pierced_`
  // to the edges that are in the way. A vertex of `on` is on the wall, whatever its rounded place;
  // another one is in front or behind. Returns whether the facets fill the border.
  bool follow(const Corners& v, std::span<const VertexId> border, std::span<const VertexId> on) {
    const auto side_of = [&](VertexId p) {
      if (std::ranges::find(on, p) != on.end()) return 0;
      return orient3d(at(v[0]), at(v[1]), at(v[2]), at(p)) < 0 ? -1 : 1;
    };
    facets_.clear();
    pierced_.clear();
    // Directed edges that want a facet to their left.
    std::vector<std::pair<VertexId, VertexId>> front;
    for (std::size_t n = 0; n < border.size(); ++n) {
      front.emplace_back(border[n], border[(n + 1) % border.size()]);
    }
    bool is_filled = true;
    for (std::size_t n = 0; n < front.size(); ++n) {
      const auto [a, b] = front[n];
      if (a == kNoId) continue;
      const CellId cell = mesh_.cell_with(a, b);
      if (cell == kNoId) return false;
      find_ring(mesh_, cell, a, b, ring_);
      const std::size_t size = ring_.v.size();
      const auto side = [&](std::size_t k) { return side_of(ring_.v[k % size]); };
      // A facet beyond the border has an edge of it the other way round.
      const auto leaves = [&, a = a, b = b](std::size_t k) {
        return follows(border, ring_.v[k], b) || follows(border, a, ring_.v[k]);
      };
      // The last vertex that is not in front before one that is. Rounding may show more of them
      // beyond the wall's edge, or none.
      std::size_t i = size + 1;
      int most_sure = 0;
      for (std::size_t k = 0; k < size; ++k) {
        if (side(k) > 0 || side(k + 1) <= 0 || leaves(k)) continue;
        std::size_t from = k + size;
        while (from > k + 1 && side(from) == 0) --from;
        const int sure = side(k) == 0 ? (side(from) < 0 ? 3 : 2)
                         : crosses(v, ring_.v[k], ring_.v[(k + 1) % size]) ? 3 : 1;
        if (sure > most_sure) i = k, most_sure = sure;
      }
      for (std::size_t k = 0; k < size && i > size; ++k) {
        if (side(k) == 0 && side(k + 1) < 0 && !leaves(k)) i = k;
      }
      if (i > size || !ring_.is_closed) return false;
      i %= size;
      const VertexId c = ring_.v[i];
      if (side(i) < 0) {
        pierced_.push_back({ring_.cells[i], c, ring_.v[(i + 1) % size]});
        is_filled = false;
        continue;
      }
      const VertexId next = ring_.v[(i + 1) % size];
      const Facet facet{ring_.cells[i], corner_index(mesh_.corners(ring_.cells[i]), next)};
      if (bool is_swapped = false;
          mesh_.is_wall(facet) && part_with({a, b, c}, is_swapped) == nullptr)
        return false;
      if (facets_.size() > 2 * on.size()) {  // no disk has so many
        pierced_.clear();
        return false;
      }
      facets_.push_back({a, b, c});
      front[n].first = kNoId;
      for (const auto& [from, to] : {std::pair{b, c}, {c, a}}) {
        const auto open = std::ranges::find(front, std::pair(from, to));
        if (open != front.end()) {
          open->first = kNoId;
        } else {
          front.emplace_back(to, from);
        }
      }
    }
    return is_filled;
  }

  // True if the areas of `facets_` sum up to the wall's, but for a rounding, and those that another
  // wall has are as small: they are not folded, and no wall covers another one.
  bool fits(const Corners& v) {
    const double longest = std::sqrt(longest_edge2(at(v[0]), at(v[1]), at(v[2])));
    const double rounding = kMostRounding * largest_coordinate_ * longest;
    double sum = 0, shared = 0;
    for (const Corners& facet : facets_) {
      const double area = twice_area(facet);
      sum += area;
      if (mesh_.is_wall(mesh_.facet_with(facet[0], facet[1], facet[2]))) shared += area;
    }
    const double whole = twice_area(v);
    return std::max(sum - whole, shared) <= rounding + 1e-13 * whole;
  }
  double twice_area(const Corners& v) const {
    return length(area_normal(at(v[0]), at(v[1]), at(v[2])));
  }

  // Returns the part that is this facet, seen from the same side, or with its regions swapped.
  // Null if the facet is no part, or a whole wall.
  Wall* part_with(const Corners& v, bool& is_swapped) {
    const auto found = std::ranges::find_if(parts_, [&](const Wall& part) {
      const auto& [a, b, c] = part.v;
      is_swapped = v == Corners{b, a, c} || v == Corners{c, b, a} || v == Corners{a, c, b};
      return is_swapped || v == part.v || v == Corners{b, c, a} || v == Corners{c, a, b};
    });
    return found == parts_.end() ? nullptr : &*found;
  }

  // Makes the facet part of a wall. Where a cut left an edge beside its line, two walls of the edge
  // may have the facet between: then what is in front of one is beyond the other.
  void add_part(const Wall& part) {
    const Facet f = mesh_.facet_with(part.v[0], part.v[1], part.v[2]);
    if (!mesh_.is_wall(f)) {
      mesh_.set_wall(f);
      parts_.push_back(part);
      return;
    }
    bool is_swapped = false;
    Wall& other = *part_with(part.v, is_swapped);
    const auto [front, behind] =
        is_swapped ? std::pair(part.behind, part.front) : std::pair(part.front, part.behind);
    if (other.front == behind) {
      other.front = front;
    } else {
      other.behind = behind;
    }
    if (other.front != other.behind) return;
    mesh_.set_wall(f, false);
    other = parts_.back();
    parts_.pop_back();
  }

  // Returns whether the wall is there now.
  bool recover_wall(std::size_t w, bool may_cut) {
    const Corners v = walls_[w].v;
    const std::vector<VertexId> border = wall_edges_.border(v);
    std::vector<VertexId> on = border;
    if (cuts_of_.contains(w)) on.insert(on.end(), cuts_of_[w].begin(), cuts_of_[w].end());
    const auto may_join = [&](VertexId p, VertexId q) { return !crosses(v, p, q); };
    for (std::size_t tries = 0; tries < kMostTries + (may_cut ? kMostCutsOfWall : 0); ++tries) {
      if (follow(v, border, on)) {
        if (border.size() == 3 && facets_.size() == 1) return mark(v);
        if (!fits(v)) return false;
        for (const Corners& facet : facets_) {
          add_part({facet, walls_[w].front, walls_[w].behind, walls_[w].kind});
        }
        walls_[w].v[0] = kNoId;
        return true;
      }
      const bool moved =
          tries < kMostTries && std::ranges::any_of(pierced_, [&](const Pierced& edge) {
            if (wall_edges_.has(edge.p, edge.q)) return false;
            find_ring(mesh_, edge.cell, edge.p, edge.q, ring_);
            return remove_edge(mesh_, ring_, kPositive, may_join) || shrink_ring(v);
          });
      if (moved) continue;
      VertexId x = kNoId;
      for (std::size_t n = 0; may_cut && x == kNoId && n < pierced_.size(); ++n) {
        x = cut_wall(v, pierced_[n]);
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
      if (crosses(wall, ring.v[i], mesh_.corners(g.cell)[g.index])) continue;
      if (remove_facet(mesh_, {c, index}, kPositive)) return true;
    }
    return false;
  }

  CellMesh& mesh_;
  std::vector<Wall>& walls_;
  WallEdges wall_edges_;
  // Rounded edges that nearly touch may go on for ever: then another order is tried.
  std::size_t most_cuts_;
  double largest_coordinate_;
  bool is_reversed_;
  // Of the edges or walls that moves leave, one in as many is cut before moves are tried again.
  std::size_t share_cut_;
  RecoveryCounts counts_;
  std::deque<std::pair<VertexId, VertexId>> edges_;
  std::deque<std::size_t> missing_;
  std::map<std::size_t, std::vector<VertexId>> cuts_of_;  // a wall, inside
  std::vector<Wall> parts_;                               // of walls that were cut
  std::vector<Corners> facets_;                           // by follow()
  std::vector<Pierced> pierced_;                          // by follow()
  std::vector<CellId> star_;
  Ring ring_;
};

}  // namespace

RecoveryCounts recover(CellMesh& mesh, std::vector<Wall>& walls, int turn) {
  return Recovery(mesh, walls, turn).run();
}

}  // namespace deliso
