// SPDX-License-Identifier: MIT
// One point: where it is, what it destroys, what takes the place (Bowyer 1981, Watson 1981).
#include "delaunay/predicates.h"
#include "delaunay/triangulation.h"

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

  // Flood fill from the cell that holds p; the list of cells found is also the queue.
  in_conflict_ += 2;
  const std::uint32_t not_in_conflict = in_conflict_ + 1;
  marks_[start] = in_conflict_;
  zone.cells.push_back(start);
  for (std::size_t k = 0; k < zone.cells.size(); ++k) {
    const CellId c = zone.cells[k];
    for (int i = 0; i < 4; ++i) {
      const CellId n = neighbor(c, i);
      if (marks_[n] == in_conflict_) continue;
      if (marks_[n] != not_in_conflict && is_in_conflict(n, p)) {
        marks_[n] = in_conflict_;
        zone.cells.push_back(n);
      } else {
        marks_[n] = not_in_conflict;
        zone.boundary.push_back({c, i});
      }
    }
  }
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
  in_conflict_ += 2;
  for (CellId c : zone.cells) marks_[c] = in_conflict_;

  // The new cells and their links to the cells outside. Links between zone cells stay as they are.
  created.clear();
  for (const Facet& f : zone.boundary) {
    const CellId c = new_cell();
    created.push_back(c);
    Cell& cell = cells_[c];
    cell.vertices = cells_[f.cell].vertices;
    cell.vertices[f.index] = v;
    cell.links.fill(kNoId);
    connect(link({c, f.index}), cells_[f.cell].links[f.index]);
    for (VertexId w : cell.vertices) incident_[w] = c;
  }

  // The links among new cells: two of them meet behind each edge of the zone's boundary.
  for (std::size_t k = 0; k < created.size(); ++k) {
    const Facet& f = zone.boundary[k];
    for (int i = 0; i < 4; ++i)
      if (cells_[created[k]].links[i] == kNoId)
        connect(link({created[k], i}), turn_through_zone(f, i));
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
