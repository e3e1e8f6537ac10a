// SPDX-License-Identifier: MIT
// Insertion of one point: locate it, find the cells in conflict, replace them (Bowyer 1981, Watson
// 1981).
#include "delaunay/triangulation.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "exact/predicates.h"

namespace deliso {

CellId Triangulation::locate(const Vec3& p, CellId hint, std::size_t& walked) const {
  DELISO_CHECK(!cells_.empty());
  CellId c = hint < cells_.size() && is_live(hint) ? hint : last_created_;
  if (is_infinite(c)) c = neighbor(c, 0);

  // Cross any facet with p strictly on its other side, except the one just crossed.
  int entered = -1;
  while (true) {
    std::array<const Vec3*, 4> corner = corners(c);
    Link next = kNoId;
    for (int i = 0; i < 4 && next == kNoId; ++i) {
      if (i == entered) continue;
      const Vec3* apex = corner[i];
      corner[i] = &p;
      if (orient3d(*corner[0], *corner[1], *corner[2], *corner[3]) < 0) next = cells_[c].links[i];
      corner[i] = apex;
    }
    if (next == kNoId) return c;
    c = CellId(next >> 2);
    ++walked;
    if (is_infinite(c)) return c;
    entered = static_cast<int>(next & 3);
  }
}

bool Triangulation::is_in_conflict(CellId c, const Vec3& p) const {
  std::array<const Vec3*, 4> v = corners(c);
  if (!is_infinite(c)) return insphere(*v[0], *v[1], *v[2], *v[3], p) > 0;
  v[0] = &p;
  const int side = orient3d(*v[0], *v[1], *v[2], *v[3]);
  // In the plane of the hull facet, the sphere of the finite cell behind it cuts out the facet's
  // circumcircle. So no further predicate is needed.
  return side != 0 ? side > 0 : is_in_conflict(neighbor(c, 0), p);
}

// Starts a search: all marks become those of earlier searches.
void Triangulation::begin_search() const {
  constexpr std::uint32_t kMaxMark = std::numeric_limits<std::uint32_t>::max() - 3;
  if (in_conflict_ >= kMaxMark) {  // unreachable: after 2^31 searches
    std::fill(marks_.begin(), marks_.end(), 0);
    in_conflict_ = 0;
  }
  in_conflict_ += 2;
}

// Conflicts are as good as random, so no branch depends on them: the list is written in any case,
// and grows or does not.
void Triangulation::keep_conflicts(const Vec3& p, std::size_t begin,
                                   std::vector<CellId>& cells) const {
  std::size_t kept = begin;
  for (std::size_t k = begin; k < cells.size(); ++k) {
    const CellId c = cells[k];
    const bool in_conflict = is_in_conflict(c, p);
    cells[kept] = c;
    marks_[c] -= in_conflict;
    kept += in_conflict;
  }
  cells.resize(kept);
}

void Triangulation::find_conflicts(const Vec3& p, CellId hint, ConflictZone& zone) const {
  zone.cells.clear();
  zone.boundary.clear();
  zone.duplicate = kNoId;
  zone.walked = 0;
  const CellId start = locate(p, hint, zone.walked);
  for (SiteId v : cells_[start].vertices) {
    if (v != kInfinite && points_[v] == p) {
      zone.duplicate = v;
      return;
    }
  }

  // Flood fill from the cell that holds p, each round from the cells found in the last one.
  begin_search();
  const std::uint32_t in_conflict = in_conflict_;
  std::uint32_t* const marks = marks_.data();
  marks[start] = in_conflict;
  zone.cells.assign(1, start);
  for (std::size_t begin = 0, end = 1; begin < end; begin = end, end = zone.cells.size()) {
    zone.cells.resize(end + 4 * (end - begin));
    CellId *from = &zone.cells[begin], *const last = &zone.cells[end], *to = last;
    for (; from != last; ++from) {
      for (Link l : cells_[*from].links) {
        const CellId c(l >> 2);
        std::uint32_t& mark = marks[c];
        const bool is_new = mark < in_conflict;
        mark = is_new ? in_conflict + 1 : mark;
        __builtin_prefetch(&cells_[c]);
        *to = c;
        to += is_new;
      }
    }
    zone.cells.resize(static_cast<std::size_t>(to - zone.cells.data()));
    keep_conflicts(p, end, zone.cells);
  }

  // Inner facets connect the zone: at least one less than it has cells. So at most 2 cells + 2 of
  // the cells' facets are on its boundary. One more entry is a dummy write.
  zone.boundary.resize(2 * zone.cells.size() + 3);
  Facet* to = zone.boundary.data();
  for (CellId c : zone.cells) {
    for (int i = 0; i < 4; ++i) {
      *to = {c, i};
      to += marks[neighbor(c, i)] != in_conflict;
    }
  }
  zone.boundary.resize(static_cast<std::size_t>(to - zone.boundary.data()));
}

void Triangulation::allocate_cells(std::size_t count, std::vector<CellId>& taken) {
  const std::size_t reused = std::min(count, free_.size());
  taken.assign(free_.rbegin(), free_.rbegin() + static_cast<std::ptrdiff_t>(reused));
  free_.resize(free_.size() - reused);
  DELISO_CHECK(cells_.size() + (count - reused) <= (1u << 30));
  while (taken.size() < count) {
    taken.emplace_back(cells_.size());
    cells_.emplace_back();
    marks_.push_back(0);
  }
}

// Links the new cells. Two of them meet behind each edge of the zone's boundary. One boundary facet
// passes the edge from its first vertex to the second, the other back. So a table of vertex pairs
// joins them: no entry is read before it is written, and no branch depends on the data.
void Triangulation::link_by_table(const ConflictZone& zone, const std::vector<CellId>& created) {
  constexpr std::uint32_t kMaxRank = std::numeric_limits<std::uint32_t>::max() - kTableVertices;
  if (first_rank_ > kMaxRank) {  // unreachable: after 2^32 ranks
    std::fill(ranks_.begin(), ranks_.end(), 0);
    first_rank_ = 1;
  }
  const std::uint32_t first_rank = first_rank_;
  std::uint32_t next_rank = first_rank;
  std::array<std::array<std::uint32_t, 3>, std::size_t{2} * kTableVertices> ranks;
  for (std::size_t k = 0; k < created.size(); ++k) {
    const auto& corner = kFacetVertices[zone.boundary[k].index];
    const auto& v = cells_[created[k]].vertices;
    auto& r = ranks[k];
    for (int e = 0; e < 3; ++e) {
      std::uint32_t& known = ranks_[v[corner[e]]];
      const bool is_new = known < first_rank;
      known = is_new ? next_rank : known;
      next_rank += is_new;
      r[e] = known - first_rank;
    }
    for (int e = 0; e < 3; ++e)
      edge_table_[r[e] * kTableVertices + r[(e + 1) % 3]] = link({created[k], corner[(e + 2) % 3]});
  }
  for (std::size_t k = 0; k < created.size(); ++k) {
    const auto& corner = kFacetVertices[zone.boundary[k].index];
    auto& links = cells_[created[k]].links;
    const auto& r = ranks[k];
    for (int e = 0; e < 3; ++e)
      links[corner[(e + 2) % 3]] = edge_table_[r[(e + 1) % 3] * kTableVertices + r[e]];
  }
  first_rank_ = next_rank;
}

// Links the new cells of a zone of any size, if such a table would be too large. Sorted by edge,
// the two cells that meet there are adjacent.
void Triangulation::link_by_sorting(const ConflictZone& zone, const std::vector<CellId>& created) {
  struct Side {
    SiteId low, high;
    Link link;
  };
  std::vector<Side> sides;
  sides.reserve(3 * created.size());
  for (std::size_t k = 0; k < created.size(); ++k) {
    const auto& corner = kFacetVertices[zone.boundary[k].index];
    const auto& v = cells_[created[k]].vertices;
    for (int e = 0; e < 3; ++e) {
      const SiteId a = v[corner[e]], b = v[corner[(e + 1) % 3]];
      sides.push_back({std::min(a, b), std::max(a, b), link({created[k], corner[(e + 2) % 3]})});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
    return std::tie(s.low, s.high) < std::tie(t.low, t.high);
  });
  for (std::size_t n = 0; n < sides.size(); n += 2) connect(sides[n].link, sides[n + 1].link);
}

SiteId Triangulation::insert_in_zone(const Vec3& p, const ConflictZone& zone,
                                     std::vector<CellId>& created) {
  DELISO_ASSERT(zone.duplicate == kNoId && !zone.cells.empty());
  const SiteId v = SiteId(points_.size());
  points_.push_back(p);
  incident_.push_back(kNoId);
  ranks_.push_back(0);

  // The new cells and their links to the cells outside. Links between zone cells stay as they are.
  allocate_cells(zone.boundary.size(), created);
  for (std::size_t k = 0; k < created.size(); ++k) {
    const CellId c = created[k];
    const Facet f = zone.boundary[k];
    Cell& cell = cells_[c];
    cell.vertices = cells_[f.cell].vertices;
    cell.vertices[f.index] = v;
    connect(link({c, f.index}), cells_[f.cell].links[f.index]);
    for (SiteId w : cell.vertices) incident_[w] = c;
  }

  if (created.size() <= std::size_t{2} * (kTableVertices - 2)) {
    link_by_table(zone, created);
  } else {
    link_by_sorting(zone, created);
  }
  for (CellId c : zone.cells) cells_[c].vertices[0] = kNoId;
  free_.insert(free_.end(), zone.cells.begin(), zone.cells.end());
  last_created_ = created.back();
  return v;
}

SiteId Triangulation::insert(const Vec3& p, CellId hint) {
  find_conflicts(p, hint, scratch_zone_);
  if (scratch_zone_.duplicate != kNoId) return scratch_zone_.duplicate;
  return insert_in_zone(p, scratch_zone_, scratch_created_);
}

}  // namespace deliso
