// SPDX-License-Identifier: MIT
// Follows a wall whose edges are edges of cells, from its border inwards, by signs alone.
//
// At an edge of the wall, the cells around it are in front or behind; the facet between is the
// wall's. Where a cell is on both sides, an edge of it pierces the wall.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "more/solids/cell_mesh.h"
#include "more/solids/moves.h"

namespace deliso {

using Corners = std::array<VertexId, 3>;

// True if the segment p q crosses the inside of the wall. Exact; false where it touches.
bool crosses(const IdArray<VertexId, Vec3>& points, const Corners& wall, VertexId p, VertexId q);

// Parts of walls that were cut: facets that are marked as walls.
class WallParts {
 public:
  explicit WallParts(CellMesh& mesh) : mesh_(mesh) {}

  const std::vector<Wall>& walls() const { return walls_; }
  // True if the facet is a part. A whole wall is none.
  bool has(const Corners& v) const;
  // Where a cut left an edge beside its line, walls of the edge may have the facet between. Then it
  // divides what is in front of the first from what is behind the last; if that is one region, it
  // is no wall any more. pre: a wall that is there is a part.
  void add(const Wall& part);

 private:
  CellMesh& mesh_;
  std::vector<Wall> walls_;
};

// An edge p q of cells that crosses a wall, and a cell at it.
struct Pierced {
  CellId cell;
  VertexId p, q;
};

class WallFollower {
 public:
  WallFollower(const CellMesh& mesh, const WallParts& parts);

  // Returns whether facets fill the border. Vertices of `on`, such as the border's, are on the
  // wall, whatever their rounded places; others are in front or behind.
  bool follow(const Corners& v, std::span<const VertexId> border, std::span<const VertexId> on);
  // What follow() found: facets of the wall, and edges that are in the way.
  const std::vector<Corners>& facets() const { return facets_; }
  const std::vector<Pierced>& pierced() const { return pierced_; }
  // True if the areas of the facets sum up to the wall's, but for a rounding, and those that
  // another wall has are as small: the facets are not folded, and no wall covers another one.
  bool fits(const Corners& v) const;

 private:
  double twice_area(const Corners& v) const;

  const CellMesh& mesh_;
  const WallParts& parts_;
  double largest_coordinate_ = 0;
  std::vector<Corners> facets_;
  std::vector<Pierced> pierced_;
  Ring ring_;
};

}  // namespace deliso
