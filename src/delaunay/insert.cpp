// SPDX-License-Identifier: MIT
// One point: where it is, what it destroys, what takes the place (Bowyer 1981, Watson 1981).
#include "delaunay/triangulation.h"

#include <algorithm>
#include <limits>

#include "delaunay/predicates.h"
#include "delaunay/tet_tables.h"

namespace deliso {

CellId Triangulation::locate(const Vec3& p, CellId hint) const {
  DELISO_CHECK(!cells_.empty());
  CellId c = hint < cells_.size() && is_live(hint) ? hint : last_created_;
  if (const int i = infinite_index(c); i >= 0) c = neighbor(c, i);

  // Cross any facet that has p strictly on its other side, except the one just crossed.
  int entered = -1;
  while (true) {
    const Cell& cell = cells_[c];
    std::array<const Vec3*, 4> corner;
    for (int i = 0; i < 4; ++i) corner[i] = &points_[cell.vertices[i]];
    Link next = kNoId;
    for (int i = 0; i < 4 && next == kNoId; ++i) {
      if (i == entered) continue;
      const Vec3* apex = corner[i];
      corner[i] = &p;
      if (orient3d(*corner[0], *corner[1], *corner[2], *corner[3]) < 0) next = cell.links[i];
      corner[i] = apex;
    }
    if (next == kNoId) return c;
    c = next >> 2;
    if (is_infinite(c)) return c;
    entered = static_cast<int>(next & 3);
  }
}

bool Triangulation::is_in_conflict(CellId c, const Vec3& p) const {
  const int i = infinite_index(c);
  if (i < 0) {
    const auto& v = cells_[c].vertices;
    return insphere(points_[v[0]], points_[v[1]], points_[v[2]], points_[v[3]], p) > 0;
  }
  std::array<const Vec3*, 4> corner;
  for (int k = 0; k < 4; ++k) corner[k] = &points_[cells_[c].vertices[k]];
  corner[i] = &p;
  const int side = orient3d(*corner[0], *corner[1], *corner[2], *corner[3]);
  // In the plane of the hull facet, its circumcircle is where the sphere of the finite cell
  // behind it cuts that plane: no further predicate is needed.
  return side != 0 ? side > 0 : is_in_conflict(neighbor(c, i), p);
}

// Makes all marks those of earlier searches.
void Triangulation::begin_search() const {
  constexpr std::uint32_t kLast = std::numeric_limits<std::uint32_t>::max() - 3;
  if (in_conflict_ >= kLast) {
    std::fill(marks_.begin(), marks_.end(), 0);
    in_conflict_ = 0;
  }
  in_conflict_ += 2;
}

void Triangulation::find_conflicts(const Vec3& p, CellId hint, ConflictZone& zone) const {
  zone.cells.clear();
  zone.boundary.clear();
  zone.duplicate = kNoId;
  const CellId start = locate(p, hint);
  for (VertexId v : cells_[start].vertices) {
    if (v != kInfinite && points_[v] == p) {
      zone.duplicate = v;
      return;
    }
  }

  // Flood fill from the cell that holds p; the list of cells found is also the queue. Whether a
  // cell is in conflict is as good as random, so no branch depends on it: both lists are written
  // in any case, and grow or do not.
  begin_search();
  marks_[start] = in_conflict_;
  zone.cells.assign(1, start);
  std::size_t cell_count = 1, facet_count = 0;
  for (std::size_t k = 0; k < cell_count; ++k) {
    const CellId c = zone.cells[k];
    if (zone.cells.size() < cell_count + 4) zone.cells.resize(2 * cell_count + 64);
    if (zone.boundary.size() < facet_count + 4) zone.boundary.resize(2 * facet_count + 64);
    for (int i = 0; i < 4; ++i) {
      const CellId n = neighbor(c, i);
      const bool untested = marks_[n] < in_conflict_;
      if (untested) marks_[n] = in_conflict_ + !is_in_conflict(n, p);
      const bool in_conflict = marks_[n] == in_conflict_;
      zone.cells[cell_count] = n;
      cell_count += untested & in_conflict;
      zone.boundary[facet_count] = {c, i};
      facet_count += !in_conflict;
    }
  }
  zone.cells.resize(cell_count);
  zone.boundary.resize(facet_count);
}

CellId Triangulation::new_cell() {
  if (free_.empty()) {
    DELISO_CHECK(cells_.size() < (1u << 30));
    cells_.emplace_back();
    marks_.push_back(0);
    return static_cast<CellId>(cells_.size() - 1);
  }
  const CellId c = free_.back();
  free_.pop_back();
  return c;
}

// Two new cells meet behind each edge of the zone's boundary. One boundary facet turns around it
// from its first vertex to the second, the other back. So a table of vertex pairs joins them: no
// entry is read before it is written, and no branch depends on the data.
void Triangulation::link_by_table(const ConflictZone& zone, const std::vector<CellId>& created) {
  // The boundary is a triangulated sphere: Euler's relation gives its number of vertices.
  const std::uint32_t vertex_count = static_cast<std::uint32_t>(created.size() / 2 + 2);
  if (first_rank_ > std::numeric_limits<std::uint32_t>::max() - vertex_count) {
    std::fill(ranks_.begin(), ranks_.end(), 0);
    first_rank_ = 1;
  }
  std::uint32_t next_rank = first_rank_;
  const auto rank = [&](VertexId v) {
    const std::uint32_t known = ranks_[v];
    const bool is_new = known < first_rank_;
    const std::uint32_t r = is_new ? next_rank : known;
    next_rank += is_new;
    ranks_[v] = r;
    return r - first_rank_;
  };
  edge_table_.resize(kTableVertices * kTableVertices);
  std::array<std::array<std::uint32_t, 3>, 2 * kTableVertices> ranks;
  for (std::size_t k = 0; k < created.size(); ++k) {
    const auto& corner = kFacetVertices[zone.boundary[k].index];
    const auto& v = cells_[created[k]].vertices;
    auto& r = ranks[k];
    for (int e = 0; e < 3; ++e) r[e] = rank(v[corner[e]]);
    for (int e = 0; e < 3; ++e)
      edge_table_[r[e] * vertex_count + r[(e + 1) % 3]] = link({created[k], corner[(e + 2) % 3]});
  }
  for (std::size_t k = 0; k < created.size(); ++k) {
    const auto& corner = kFacetVertices[zone.boundary[k].index];
    auto& links = cells_[created[k]].links;
    const auto& r = ranks[k];
    for (int e = 0; e < 3; ++e)
      links[corner[(e + 2) % 3]] = edge_table_[r[(e + 1) % 3] * vertex_count + r[e]];
  }
  first_rank_ = next_rank;
}

// The same for zones of any size, where such a table would be too large.
void Triangulation::link_by_turning(const ConflictZone& zone, const std::vector<CellId>& created) {
  begin_search();
  for (CellId c : zone.cells) marks_[c] = in_conflict_;
  for (std::size_t k = 0; k < created.size(); ++k) {
    const Facet& f = zone.boundary[k];
    for (int i = 0; i < 4; ++i)
      if (i != f.index) cells_[created[k]].links[i] = turn_through_zone(f, i);
  }
}

Triangulation::Link Triangulation::turn_through_zone(Facet f, int over) const {
  // In each cell passed the edge joins the vertices other than f.index and `over`.
  while (true) {
    const Link crossed = cells_[f.cell].links[over];
    const Cell& next = cells_[crossed >> 2];
    if (marks_[crossed >> 2] != in_conflict_) {
      const CellId new_neighbor = next.links[crossed & 3] >> 2;
      return link({new_neighbor, f.index});
    }
    const VertexId behind = cells_[f.cell].vertices[f.index];
    f = facet(crossed);
    const auto& v = next.vertices;
    over = v[0] == behind ? 0 : v[1] == behind ? 1 : v[2] == behind ? 2 : 3;
  }
}

VertexId Triangulation::insert_in_zone(const Vec3& p, const ConflictZone& zone,
                                       std::vector<CellId>& created) {
  DELISO_ASSERT(zone.duplicate == kNoId && !zone.cells.empty());
  const VertexId v = static_cast<VertexId>(points_.size());
  points_.push_back(p);
  incident_.push_back(kNoId);
  ranks_.push_back(0);

  // The new cells and their links to the cells outside. Links between zone cells stay as they are.
  created.clear();
  for (const Facet& f : zone.boundary) {
    const CellId c = new_cell();
    created.push_back(c);
    Cell& cell = cells_[c];
    cell.vertices = cells_[f.cell].vertices;
    cell.vertices[f.index] = v;
    connect(link({c, f.index}), cells_[f.cell].links[f.index]);
    for (VertexId w : cell.vertices) incident_[w] = c;
  }

  if (created.size() <= 2 * (kTableVertices - 2)) {
    link_by_table(zone, created);
  } else {
    link_by_turning(zone, created);
  }
  for (CellId c : zone.cells) {
    cells_[c].vertices[0] = kNoId;
    free_.push_back(c);
  }
  last_created_ = created.back();
  return v;
}

VertexId Triangulation::insert(const Vec3& p, CellId hint) {
  find_conflicts(p, hint, scratch_zone_);
  if (scratch_zone_.duplicate != kNoId) return scratch_zone_.duplicate;
  return insert_in_zone(p, scratch_zone_, scratch_created_);
}

}  // namespace deliso
