// SPDX-License-Identifier: MIT
// The strict rule is the limit of lifting each new point infinitely more than all before it. So the
// result is a regular triangulation even if many points are cospherical. Hence the visibility walk
// of locate() never returns to a cell and terminates, given exact predicates (Edelsbrunner 1990,
// "An acyclicity theorem for cell complexes in d dimensions").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/box3.h"
#include "base/check.h"
#include "base/ids.h"
#include "base/vec3.h"

namespace deliso {

// The vertices of facet i, opposite to vertex i, of a cell 0 1 2 3. They are counter-clockwise seen
// from outside, as the vertices 0 1 2 3 are positively oriented (predicates.h).
inline constexpr std::array<std::array<int, 3>, 4> kFacetVertices = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

// The facet of `cell` opposite to its vertex number `index`.
struct Facet {
  CellId cell = kNoId;
  int index = 0;
  friend bool operator==(const Facet&, const Facet&) = default;
};

// The three sites of a facet.
using SiteTriangle = std::array<SiteId, 3>;

// Returns the three as corners in a mesh whose vertices have the sites' numbers.
inline std::array<VertexId, 3> as_mesh_triangle(const SiteTriangle& t) {
  return {VertexId(t[0].number()), VertexId(t[1].number()), VertexId(t[2].number())};
}

// The cells that a new point would destroy: their circumspheres hold it. They are a star-shaped
// region around it. Reused from insertion to insertion to save allocations.
struct ConflictZone {
  std::vector<CellId> cells;
  std::vector<Facet> boundary;  // facets of conflict cells whose other cell stays
  SiteId duplicate = kNoId;     // the vertex at p itself; then nothing is in conflict
  std::size_t walked = 0;       // cells on the way to p
};

// Coordinates: finite, any unit, in the range of predicates.h. Up to 2^30 cells. Const functions
// may run in several threads at once, except find_conflicts (it marks cells).
class Triangulation {
 public:
  static constexpr SiteId kInfinite = 0;  // finite vertices are 1, 2, ...

  // Inserts all points in a biased randomized Hilbert order (Amenta, Choi and Rote 2003), which
  // depends only on the points and their order. Vertex ids[i] is points[i]; duplicates share one.
  // Returns false, and stays empty, if all points lie in one plane. The same if it would create or
  // walk through more than `max_cells` cells for each point, destroyed ones included.
  bool build(std::span<const Vec3> points, std::vector<SiteId>& ids, std::size_t max_cells = kNoId);

  std::size_t vertex_capacity() const { return points_.size(); }  // ids are below; 0 is infinite
  std::size_t cell_capacity() const { return cells_.size(); }     // ids are below; some are free
  bool is_live(CellId c) const { return cells_[c].vertices[0] != kNoId; }

  const Vec3& point(SiteId v) const { return points_[v]; }
  SiteId vertex(CellId c, int i) const { return cells_[c].vertices[i]; }
  CellId neighbor(CellId c, int i) const { return facet(cells_[c].links[i]).cell; }
  const std::array<SiteId, 4>& vertices(CellId c) const { return cells_[c].vertices; }
  bool is_infinite(CellId c) const { return cells_[c].vertices[0] == kInfinite; }
  // Returns which vertex of c is the infinite one (I5); -1 if c is finite.
  int infinite_index(CellId c) const { return is_infinite(c) ? 0 : -1; }
  CellId incident_cell(SiteId v) const { return incident_[v]; }
  // Returns the facet as its other cell sees it.
  Facet mirror(Facet f) const { return facet(cells_[f.cell].links[f.index]); }

  // Returns the cell that holds p (an infinite one if p is outside the hull), by a remembering walk
  // from `hint`. Each step adds one to `walked`. If `hint` is kNoId or a free cell, the walk starts
  // at the last cell created. pre, here and below: build() has succeeded.
  CellId locate(const Vec3& p, CellId hint, std::size_t& walked) const;
  // Finds the conflict zone of p. Const: nothing changes until insert_in_zone.
  void find_conflicts(const Vec3& p, CellId hint, ConflictZone& zone) const;
  // Stars the zone from p and returns the new vertex. created[k] is the new cell on
  // zone.boundary[k] = (c, i). It has the vertices of c with p in place of number i, so the
  // surviving facet keeps its index. The ids of the zone's cells become free. `created` uses ids
  // freed earlier, or new ones. pre: find_conflicts(p) made this zone, nothing was inserted since,
  // and p is no duplicate.
  SiteId insert_in_zone(const Vec3& p, const ConflictZone& zone, std::vector<CellId>& created);
  // Runs locate, find_conflicts and insert_in_zone; returns the existing vertex for a duplicate.
  SiteId insert(const Vec3& p, CellId hint = kNoId);

 private:
  // A link names a facet in one word, 4 * cell + index. Here links[i] is the facet opposite to
  // vertex i as the neighbor sees it, so a walk needs no search. One cell is half a cache line.
  using Link = std::uint32_t;
  struct alignas(32) Cell {
    std::array<SiteId, 4> vertices;  // vertices[0] == kNoId: free
    std::array<Link, 4> links;
  };
  static Link link(Facet f) { return 4 * f.cell + static_cast<Link>(f.index); }
  static Facet facet(Link l) { return {CellId(l >> 2), static_cast<int>(l & 3)}; }

  void clear();
  void connect(Link a, Link b) {
    cells_[facet(a).cell].links[a & 3] = b;
    cells_[facet(b).cell].links[b & 3] = a;
  }
  std::array<const Vec3*, 4> corners(CellId c) const {
    const auto& v = cells_[c].vertices;
    return {&points_[v[0]], &points_[v[1]], &points_[v[2]], &points_[v[3]]};
  }
  void create_first_cells(const std::array<Vec3, 4>& corners);
  bool is_in_conflict(CellId c, const Vec3& p) const;
  // Keeps, of the cells from number `begin` on, those in conflict with p, in their order, and marks
  // them. pre: they are marked as tested.
  void keep_conflicts(const Vec3& p, std::size_t begin, std::vector<CellId>& cells) const;
  // Sets `taken` to ids for `count` new cells: freed ones, the last freed first, then new ones.
  void allocate_cells(std::size_t count, std::vector<CellId>& taken);
  void begin_search() const;
  void link_by_table(const ConflictZone& zone, const std::vector<CellId>& created);
  void link_by_sorting(const ConflictZone& zone, const std::vector<CellId>& created);

  IdArray<SiteId, Vec3> points_;
  IdArray<SiteId, CellId> incident_;
  IdArray<CellId, Cell> cells_;
  std::vector<CellId> free_;
  CellId last_created_ = kNoId;

  // Marks of the last search: in_conflict_, or in_conflict_ + 1 for a tested cell without conflict.
  mutable std::vector<std::uint32_t> marks_;
  mutable std::uint32_t in_conflict_ = 0;
  // Numbers the vertices of a zone's boundary from 0: ranks_[v] - first_rank_. Smaller ranks are
  // those of earlier insertions.
  static constexpr std::uint32_t kTableVertices = 64;
  std::vector<std::uint32_t> ranks_;
  std::uint32_t first_rank_ = 1;
  std::vector<Link> edge_table_ = std::vector<Link>(std::size_t{kTableVertices} * kTableVertices);

  ConflictZone scratch_zone_;
  std::vector<CellId> scratch_created_;
};

// Appends the corners of a regular tetrahedron around the box, 16 of its diagonals away. With these
// auxiliary points there is a triangulation even where all others lie in one plane, and the hull is
// far from them.
inline constexpr std::size_t kAuxiliaryVertices = 4;
void append_auxiliary(const Box3& box, std::vector<Vec3>& points);
// True if p is one of them. pre: else it is in the box.
inline bool is_auxiliary(const Vec3& p, const Box3& box) {
  return distance2(p, box.middle()) > length2(box.size());
}

// Returns the vertices of f, counter-clockwise seen from outside f.cell.
inline SiteTriangle facet_vertices(const Triangulation& t, Facet f) {
  const auto& v = t.vertices(f.cell);
  const auto& index = kFacetVertices[f.index];
  return {v[index[0]], v[index[1]], v[index[2]]};
}

// Calls visit(facet) once for each facet, as the cell of the smaller number sees it.
template <class Visit>
void for_each_facet(const Triangulation& t, Visit&& visit) {
  for (CellId c = 0; c < t.cell_capacity(); ++c) {
    for (int i = 0; i < 4 && t.is_live(c); ++i) {
      if (c < t.neighbor(c, i)) visit(Facet{c, i});
    }
  }
}

inline bool has_infinite_vertex(const Triangulation& t, Facet f) {
  const int infinite = t.infinite_index(f.cell);
  return infinite >= 0 && infinite != f.index;
}

}  // namespace deliso
