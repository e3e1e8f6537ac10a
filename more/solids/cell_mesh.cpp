// SPDX-License-Identifier: MIT
#include "more/solids/cell_mesh.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/check.h"

namespace deliso {

CellMesh::CellMesh(const Triangulation& cells, const IdArray<SiteId, VertexId>& vertex,
                   IdArray<VertexId, Vec3> given)
    : points(std::move(given)), incident_(points.size(), kNoId) {
  IdArray<CellId, CellId> number(cells.cell_capacity(), kNoId);
  for (CellId c = 0; c < cells.cell_capacity(); ++c) {
    if (!cells.is_live(c) || cells.is_infinite(c)) continue;
    number[c] = CellId(cells_.size());
    Cell cell;
    for (int i = 0; i < 4; ++i) {
      cell.v[i] = vertex[cells.vertex(c, i)];
      cell.n[i] = cells.mirror({c, i});
      incident_[cell.v[i]] = number[c];
    }
    cells_.push_back(cell);
  }
  for (Cell& cell : cells_) {
    for (Facet& n : cell.n) n.cell = number[n.cell];
  }
  marks_.assign(cells_.size(), 0);
}

void CellMesh::set_wall(Facet f, bool is_one) {
  for (const Facet side : {f, mirror(f)}) {
    if (side.cell == kNoId) continue;
    const auto bit = static_cast<std::uint8_t>(1u << side.index);
    std::uint8_t& walls = cells_[side.cell].walls;
    walls = static_cast<std::uint8_t>(is_one ? walls | bit : walls & ~bit);
  }
}

VertexId CellMesh::add_point(const Vec3& p) {
  points.push_back(p);
  incident_.push_back(kNoId);
  return VertexId(points.size() - 1);
}

void CellMesh::drop_point() {
  points.pop_back();
  incident_.pop_back();
}

std::array<VertexId, 3> CellMesh::sorted_facet(const Tetrahedron& v, int i) {
  const auto& f = kFacetVertices[i];
  std::array<VertexId, 3> facet{v[f[0]], v[f[1]], v[f[2]]};
  std::ranges::sort(facet);
  return facet;
}

void CellMesh::connect(Facet a, Facet b) {
  if (a.cell != kNoId) cells_[a.cell].n[a.index] = b;
  if (b.cell != kNoId) cells_[b.cell].n[b.index] = a;
}

bool CellMesh::replace_ball(std::span<const CellId> gone, std::span<const Tetrahedron> created) {
  ++mark_;
  for (CellId c : gone) marks_[c] = mark_;
  sides_.clear();
  for (CellId c : gone) {
    for (int i = 0; i < 4; ++i) {
      const Facet behind = mirror({c, i});
      const bool wall = is_wall({c, i});
      if (behind.cell == kNoId || marks_[behind.cell] != mark_) {
        sides_.push_back({sorted_facet(cells_[c].v, i), behind, false, wall});
      } else if (wall) {
        return false;
      }
    }
  }
  for (std::uint32_t k = 0; k < created.size(); ++k) {
    for (int i = 0; i < 4; ++i)
      sides_.push_back({sorted_facet(created[k], i), {CellId(k), i}, true, false});
  }
  // Each facet is now there twice: of a new cell, and of another or of the ball's boundary.
  std::ranges::sort(sides_, [](const Side& s, const Side& t) {
    return std::tie(s.v, s.is_new) < std::tie(t.v, t.is_new);
  });
  if (sides_.size() % 2 != 0) return false;
  for (std::size_t n = 0; n < sides_.size(); n += 2) {
    if (sides_[n].v != sides_[n + 1].v || !sides_[n + 1].is_new) return false;
    if (n > 0 && sides_[n].v == sides_[n - 1].v) return false;
  }

  const RegionId region = cells_[gone.front()].region;
  for (CellId c : gone) {
    free_.push_back(c);
    for (VertexId w : cells_[c].v) incident_[w] = kNoId;
    cells_[c].v[0] = kNoId;
  }
  last_created_.clear();
  for (const Tetrahedron& v : created) {
    if (free_.empty()) {
      free_.emplace_back(cells_.size());
      cells_.emplace_back();
      marks_.push_back(0);
    }
    const CellId c = free_.back();
    free_.pop_back();
    cells_[c] = {v, {}, region, 0};
    for (VertexId w : v) incident_[w] = c;
    last_created_.push_back(c);
  }
  for (std::size_t n = 0; n < sides_.size(); n += 2) {
    Side &behind = sides_[n], &own = sides_[n + 1];
    for (Side* side : {&behind, &own}) {
      if (side->is_new) side->facet.cell = last_created_[side->facet.cell.number()];
    }
    connect(own.facet, behind.facet);
    if (behind.is_wall) set_wall(own.facet);
  }
  return true;
}

void CellMesh::remove_region(RegionId region) {
  for (CellId c = 0; c < cells_.size(); ++c) {
    Cell& cell = cells_[c];
    if (!is_live(c) || cell.region != region) continue;
    for (Facet n : cell.n) connect(n, {kNoId, 0});
    cell.v[0] = kNoId;
    free_.push_back(c);
  }
  for (CellId c = 0; c < cells_.size(); ++c) {
    if (!is_live(c)) continue;
    for (VertexId v : cells_[c].v) incident_[v] = c;
  }
}

void CellMesh::cells_at(VertexId v, std::vector<CellId>& star) const {
  ++mark_;
  star.assign(1, incident_[v]);
  marks_[star.front()] = mark_;
  for (std::size_t k = 0; k < star.size(); ++k) {
    const Cell& cell = cells_[star[k]];
    for (int i = 0; i < 4; ++i) {
      const CellId n = cell.n[i].cell;
      if (cell.v[i] == v || n == kNoId || marks_[n] == mark_) continue;
      marks_[n] = mark_;
      star.push_back(n);
    }
  }
}

CellId CellMesh::cell_with(VertexId a, VertexId b) const {
  cells_at(a, star_);
  const auto found =
      std::ranges::find_if(star_, [&](CellId c) { return has_corner(cells_[c].v, b); });
  return found == star_.end() ? CellId(kNoId) : *found;
}

Facet CellMesh::facet_with(VertexId a, VertexId b, VertexId c) const {
  cells_at(a, star_);
  for (const CellId cell : star_) {
    const Tetrahedron& v = cells_[cell].v;
    if (!has_corner(v, b) || !has_corner(v, c)) continue;
    int i = 0;
    while (v[i] == a || v[i] == b || v[i] == c) ++i;
    return {cell, i};
  }
  return {};
}

}  // namespace deliso
