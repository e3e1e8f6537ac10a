// SPDX-License-Identifier: MIT
// A mesh of tetrahedra that may change: cells, their neighbors, and walls, the facets of a skin.
//
// One operation changes it: replace_ball puts cells in the place of cells, over the same boundary.
// Inserting a point, removing an edge or a facet, merging an edge and moving a vertex are ways to
// propose one.
//
// Invariants:
//   S1  Every cell is positively oriented (orient3d > 0, exact).
//   S2  Cells have facets, edges and vertices in common, or nothing.
//   S3  Each is in one region. Cells of different regions have a wall between them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/vec3.h"
#include "delaunay/triangulation.h"
#include "more/solids/solid.h"

namespace deliso {

class CellMesh {
 public:
  IdArray<VertexId, Vec3> points;

  // Takes the finite cells of a triangulation over. vertex[s] is site s here.
  CellMesh(const Triangulation& cells, const IdArray<SiteId, VertexId>& vertex,
           IdArray<VertexId, Vec3> points);

  std::size_t cell_capacity() const { return cells_.size(); }
  bool is_live(CellId c) const { return cells_[c].v[0] != kNoId; }
  const Tetrahedron& corners(CellId c) const { return cells_[c].v; }
  // The facet opposite to corner i, as its other cell sees it; cell kNoId at the mesh's border.
  Facet mirror(Facet f) const { return cells_[f.cell].n[f.index]; }
  CellId neighbor(CellId c, int i) const { return cells_[c].n[i].cell; }
  CellId incident_cell(VertexId v) const { return incident_[v]; }
  RegionId region(CellId c) const { return cells_[c].region; }
  void set_region(CellId c, RegionId region) { cells_[c].region = region; }
  bool is_wall(Facet f) const { return cells_[f.cell].walls >> f.index & 1; }
  void set_wall(Facet f, bool is_one = true);

  VertexId add_point(const Vec3& p);
  // Takes back the last point added. pre: no cell has it.
  void drop_point();
  // Moves v. pre: S1 holds for the cells at v then.
  void move(VertexId v, const Vec3& p) { points[v] = p; }

  // Puts `created` in the place of `gone`, if both have the same boundary and no wall is lost in
  // between; otherwise returns false and nothing changes. The new ids are in `last_created`. pre:
  // all of `gone` are live and in one region; S1 holds for `created`.
  bool replace_ball(std::span<const CellId> gone, std::span<const Tetrahedron> created);
  const std::vector<CellId>& last_created() const { return last_created_; }
  // Takes cells away.
  void remove_region(RegionId region);

  // Sets `star` to the cells at v.
  void cells_at(VertexId v, std::vector<CellId>& star) const;
  // Return a cell with these corners, and such a facet of one; cell kNoId if there is none.
  CellId cell_with(VertexId a, VertexId b) const;
  Facet facet_with(VertexId a, VertexId b, VertexId c) const;
  // Returns the corners of f, counter-clockwise seen from outside f.cell.
  std::array<VertexId, 3> corners(Facet f) const {
    const Tetrahedron& v = cells_[f.cell].v;
    const auto& i = kFacetVertices[f.index];
    return {v[i[0]], v[i[1]], v[i[2]]};
  }

 private:
  struct Cell {
    Tetrahedron v;  // v[0] == kNoId: free
    std::array<Facet, 4> n;
    RegionId region = kOutside;
    std::uint8_t walls = 0;
  };
  // A facet by its corners: of a new cell, then by its place among them, or what lies behind a
  // ball.
  struct Side {
    std::array<VertexId, 3> v;  // sorted
    Facet facet;
    bool is_new, is_wall;
  };
  static std::array<VertexId, 3> sorted_facet(const Tetrahedron& v, int i);
  void connect(Facet a, Facet b);

  IdArray<CellId, Cell> cells_;
  IdArray<VertexId, CellId> incident_;
  std::vector<CellId> free_, last_created_;
  std::vector<Side> sides_;
  mutable std::vector<CellId> star_;
  mutable IdArray<CellId, std::uint32_t> marks_;
  mutable std::uint32_t mark_ = 0;
};

inline bool has_corner(const Tetrahedron& v, VertexId w) {
  return v[0] == w || v[1] == w || v[2] == w || v[3] == w;
}
inline int corner_index(const Tetrahedron& v, VertexId w) {
  return v[0] == w ? 0 : v[1] == w ? 1 : v[2] == w ? 2 : 3;
}

}  // namespace deliso
