// SPDX-License-Identifier: MIT
// The Delaunay triangulation of points in space, grown point by point (Bowyer 1981, Watson 1981).
//
// Cells live in flat arrays: four vertex ids and four neighbour ids each, with a free list. There
// is one infinite vertex instead of a huge first tetrahedron, so every facet has two cells and the
// hull needs no special case.
//
// Invariants (check_triangulation tests them by these numbers):
//   I1  neighbours are mutual and share the three other vertices;
//   I2  finite cells are positively oriented: orient3d(v0, v1, v2, v3) > 0; in a cell at infinity,
//       replacing the infinite vertex by a point beyond its hull facet gives a positive cell;
//   I3  no vertex lies strictly inside the circumsphere of a finite cell, or strictly beyond the
//       hull facet of an infinite one (or in its plane and strictly inside its circumcircle);
//   I4  every vertex's incident cell holds it.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/vec3.h"

namespace deliso {

// The facet of `cell` opposite to its vertex number `index`.
struct Facet {
  CellId cell = kNoId;
  int index = 0;
  friend bool operator==(const Facet&, const Facet&) = default;
};

// What inserting a point would destroy: the cells whose circumspheres hold it, a star-shaped region
// around it. Reused from insertion to insertion to save allocations.
struct ConflictZone {
  std::vector<CellId> cells;
  std::vector<Facet> boundary;  // facets of conflict cells whose other cell stays
  VertexId duplicate = kNoId;   // the vertex at this very position; then nothing is in conflict
};

class Triangulation {
 public:
  static constexpr VertexId kInfinite = 0;  // finite vertices are 1, 2, ...

  // Inserts all points in a biased randomised Hilbert order (Amenta, Choi and Rote 2003) that
  // depends on nothing but the points and their order. ids[i] is the vertex of points[i];
  // duplicates share one. Returns false, and stays empty, when all points lie in one plane.
  bool build(std::span<const Vec3> points, std::vector<VertexId>& ids);

  std::size_t vertex_capacity() const;  // ids are below this; 0 is the infinite vertex
  std::size_t cell_capacity() const;    // ids are below this; some may be free
  bool is_live(CellId c) const;

  const Vec3& point(VertexId v) const;
  VertexId vertex(CellId c, int i) const;
  CellId neighbor(CellId c, int i) const;
  const std::array<VertexId, 4>& vertices(CellId c) const;
  bool is_infinite(CellId c) const;
  CellId incident_cell(VertexId v) const;
  Facet mirror(Facet f) const;

  // The cell that holds p (finite, or infinite when p is beyond the hull), by a remembering walk
  // from `hint` (kNoId: from anywhere).
  CellId locate(const Vec3& p, CellId hint) const;
  // The conflict zone of p. Const: nothing changes until insert_in_zone.
  void find_conflicts(const Vec3& p, CellId hint, ConflictZone& zone) const;
  // Stars the zone from p. created[k] is the new cell on zone.boundary[k] = (c, i): it has the
  // vertices of c with p in place of number i, so that the surviving facet keeps its index.
  // Ids of the zone's cells become free (and may be reused by `created`).
  // pre: find_conflicts(p) gave this zone, nothing inserted since, no duplicate.
  VertexId insert_in_zone(const Vec3& p, const ConflictZone& zone, std::vector<CellId>& created);
  // locate + find_conflicts + insert_in_zone; returns the existing vertex for a duplicate.
  VertexId insert(const Vec3& p, CellId hint = kNoId);
};

}  // namespace deliso
