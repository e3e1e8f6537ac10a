// SPDX-License-Identifier: MIT
// The method on a slice: T is drawn as loops of vertices, a facet is an edge. A slice of two layers
// has each vertex of T twice, one above the other, and so it has each site. The layers are far
// apart. So the lower one has its own labels, and the library's certificate speaks of it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/vec2.h"
#include "contour/contour.h"
#include "guide/slice.h"

namespace deliso::guide {

// Vertices of the lower layer are numbers 0, 1, ...; a site is such a number.
class FlatContour {
 public:
  explicit FlatContour(const Slice& slice);

  const std::vector<Vec2>& points() const { return points_; }
  const std::vector<std::vector<std::size_t>>& loops() const { return loops_; }
  std::size_t nearest_vertex(const Vec2& p) const;

  struct Violation {
    std::size_t site;
    std::size_t insert;  // the vertex that the certificate asks for
  };
  struct Regions {
    std::vector<std::size_t> site_of;              // of each vertex
    std::vector<std::array<std::size_t, 2>> dual;  // K: pairs of sites, along the loops
    std::optional<Violation> violation;
  };
  // pre: at least two sites, all different.
  Regions regions(const std::vector<std::size_t>& sites) const;

 private:
  ContourMesh contour_;
  std::vector<ContourId> lower_, upper_;
  std::vector<Vec2> points_;
  std::vector<std::vector<std::size_t>> loops_;
};

// An edge of the mesh with its surface point x and its surface ball.
struct FlatFacet {
  Vec2 a, b, center, x;
  double h, radius;
};

// Stage 2 on one loop of the mesh, whose inside is on the left.
class FlatMesh {
 public:
  FlatMesh(const Slice& slice, std::vector<Vec2> loop) : slice_(slice), loop_(std::move(loop)) {}

  const std::vector<Vec2>& loop() const { return loop_; }
  FlatFacet facet(std::size_t n) const;
  std::size_t worst() const;  // of the largest h
  // Inserts the surface point of edge n. Its ball must be the only one that holds this point.
  void insert(std::size_t n);

 private:
  const Slice& slice_;
  std::vector<Vec2> loop_;
};

}  // namespace deliso::guide
