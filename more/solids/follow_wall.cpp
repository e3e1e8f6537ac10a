// SPDX-License-Identifier: MIT
#include "more/solids/follow_wall.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/triangle.h"
#include "exact/predicates.h"

namespace deliso {
namespace {

// Of an area: times the largest coordinate and the wall's longest edge.
constexpr double kMostRounding = 4e-13;

// True if the border goes from a to b.
bool follows(std::span<const VertexId> border, VertexId a, VertexId b) {
  for (std::size_t n = 0; n < border.size(); ++n) {
    if (border[n] == a) return border[(n + 1) % border.size()] == b;
  }
  return false;
}

enum class Seen { kNot, kFromFront, kFromBehind };

// Whether the two are the same facet, and from which side of the first.
Seen same_facet(const Corners& v, const Corners& other) {
  const auto& [a, b, c] = other;
  if (v == other || v == Corners{b, c, a} || v == Corners{c, a, b}) return Seen::kFromFront;
  const bool is_same = v == Corners{b, a, c} || v == Corners{c, b, a} || v == Corners{a, c, b};
  return is_same ? Seen::kFromBehind : Seen::kNot;
}

}  // namespace

// True if the segment p q crosses the inside of the wall. Exact; false where it touches.
bool crosses(const IdArray<VertexId, Vec3>& points, const Corners& wall, VertexId p, VertexId q) {
  const auto at = [&](VertexId v) { return points[v]; };
  const auto& [a, b, c] = wall;
  const int side = orient3d(at(a), at(b), at(c), at(p));
  if (side * orient3d(at(a), at(b), at(c), at(q)) >= 0) return false;
  for (int k = 0; k < 3; ++k) {
    if (side * orient3d(at(wall[k]), at(wall[(k + 1) % 3]), at(q), at(p)) <= 0) return false;
  }
  return true;
}

bool WallParts::has(const Corners& v) const {
  return std::ranges::any_of(walls_,
                             [&](const Wall& part) { return same_facet(v, part.v) != Seen::kNot; });
}

void WallParts::add(const Wall& part) {
  const Facet f = mesh_.facet_with(part.v[0], part.v[1], part.v[2]);
  if (!mesh_.is_wall(f)) {
    mesh_.set_wall(f);
    walls_.push_back(part);
    return;
  }
  Wall& other = *std::ranges::find_if(
      walls_, [&](const Wall& wall) { return same_facet(part.v, wall.v) != Seen::kNot; });
  RegionId front = part.front, behind = part.behind;
  if (same_facet(part.v, other.v) == Seen::kFromBehind) std::swap(front, behind);
  if (other.front == behind) {
    other.front = front;
  } else {
    other.behind = behind;
  }
  if (other.front != other.behind) return;
  mesh_.set_wall(f, false);
  other = walls_.back();
  walls_.pop_back();
}

WallFollower::WallFollower(const CellMesh& mesh, const WallParts& parts)
    : mesh_(mesh), parts_(parts) {
  for (const Vec3& p : mesh.points) {
    largest_coordinate_ =
        std::max({largest_coordinate_, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  }
}

bool WallFollower::follow(const Corners& v, std::span<const VertexId> border,
                          std::span<const VertexId> on) {
  const auto at = [&](VertexId p) { return mesh_.points[p]; };
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
    // beyond the wall's edge, or none. Surest are a vertex on the wall that comes after one behind,
    // and an edge that crosses it.
    std::size_t i = size + 1;
    int most_sure = 0;
    for (std::size_t k = 0; k < size; ++k) {
      if (side(k) > 0 || side(k + 1) <= 0 || leaves(k)) continue;
      std::size_t from = k + size;
      while (from > k + 1 && side(from) == 0) --from;
      const int sure = side(k) == 0 ? (side(from) < 0 ? 3 : 2)
                       : crosses(mesh_.points, v, ring_.v[k], ring_.v[(k + 1) % size]) ? 3
                                                                                       : 1;
      if (sure > most_sure) i = k, most_sure = sure;
    }
    // Cells of four vertices on the wall count as behind it.
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
    if (mesh_.is_wall(facet) && !parts_.has({a, b, c})) return false;
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

bool WallFollower::fits(const Corners& v) const {
  const auto at = [&](VertexId p) { return mesh_.points[p]; };
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

double WallFollower::twice_area(const Corners& v) const {
  const auto at = [&](VertexId p) { return mesh_.points[p]; };
  return length(area_normal(at(v[0]), at(v[1]), at(v[2])));
}

}  // namespace deliso
