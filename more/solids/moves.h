// SPDX-License-Identifier: MIT
// Ways to change a mesh of cells by replace_ball. Each is done only if the least shape (quality.h)
// of the new cells is over `floor`.
//
// Edge removal: the cells around an edge are replaced by two for each triangle of a triangulation
// of their ring, the best one by dynamic programming (Shewchuk 2002, "Two discrete optimization
// algorithms for the topological improvement of tetrahedral meshes"; Klincsek 1980). Facet removal:
// two cells become three, around the edge between their apexes.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "more/solids/cell_mesh.h"

namespace deliso {

// The cells around the edge a b: cells[i] is (a, b, v[i], v[i + 1]) and positively oriented.
struct Ring {
  VertexId a, b;
  std::vector<VertexId> v;
  std::vector<CellId> cells;
  bool is_closed = false;  // false: the edge is on the mesh's border, and there is one vertex more
  bool has_wall = false;   // a wall is at the edge
};

// pre: `first` has the corners a and b.
void find_ring(const CellMesh& mesh, CellId first, VertexId a, VertexId b, Ring& ring);
double least_shape(const CellMesh& mesh, std::span<const CellId> cells);

// Below the shape of each positively oriented cell, over that of others. The shape of a flat one
// may be rounded to 0.
inline constexpr double kPositive = -.5;
inline constexpr std::size_t kMostAround = 12;  // cells around an edge that is removed

// Whether an edge between two vertices of the ring may be made.
using MayJoin = std::function<bool(VertexId, VertexId)>;

bool remove_edge(CellMesh& mesh, const Ring& ring, double floor, const MayJoin& may_join = {});
bool remove_facet(CellMesh& mesh, Facet f, double floor);
// Puts in the place of `zone` a cell for each facet of its boundary, to a new vertex at p. Returns
// the vertex, or kNoId if a shape is not over the floor. A vertex inside the zone is of no cell
// then.
VertexId star_from(CellMesh& mesh, const Vec3& p, std::span<const CellId> zone, double floor);

}  // namespace deliso
