// SPDX-License-Identifier: MIT
// A constrained Delaunay triangulation of a rectangle. It is the triangulation that has the given
// segments as edges and no vertex in a triangle's circumcircle that the triangle sees (Lee and Lin
// 1986; Chew 1989). Points enter by insertion and Lawson's flips. A segment enters by flips of the
// edges that cross it (Sloan 1993), then of all that are not Delaunay. Every decision is exact.
//
// Invariants:
//   I1  Triangles are counter-clockwise and tile the rectangle.
//   I2  Neighbors are mutual; n[i] == kNoId exactly on the rectangle's sides.
//   I3  side[i] is set on both triangles of a segment or on neither.
//   I4  Except at segments and sides, the corner across an edge is not inside the triangle's
//       circumcircle.
// Vertices 0 to 3 are the rectangle's corners, counter-clockwise from the low one.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "base/vec2.h"

namespace deliso {

enum class Side : std::uint8_t { none, inside, outside };

struct PlaneTriangle {
  std::array<VertexId, 3> v;
  std::array<FaceId, 3> n{kNoId, kNoId, kNoId};  // n[i] is across the edge opposite v[i]
  std::array<Side, 3> side{};                    // of the segment opposite v[i], as seen from here
  bool inside = false;  // set by the user; inherited when a triangle is split
};

// An edge of triangle t: the one opposite its corner i.
struct PlaneEdge {
  FaceId t = kNoId;
  int i = 0;
};

class ConstrainedTriangulation {
 public:
  // pre: lo.x < hi.x and lo.y < hi.y.
  ConstrainedTriangulation(const Vec2& lo, const Vec2& hi);

  const std::vector<Vec2>& points() const { return points_; }
  const std::vector<PlaneTriangle>& triangles() const { return triangles_; }
  const Vec2& point(VertexId v) const { return points_[v]; }
  const PlaneTriangle& triangle(FaceId t) const { return triangles_[t]; }
  PlaneTriangle& triangle(FaceId t) { return triangles_[t]; }

  // Returns the new vertex, or the vertex that is at p already. pre: p lies in the closed
  // rectangle.
  VertexId insert(const Vec2& p);
  // As insert, in a known triangle. pre: p lies in triangle t and at none of its corners.
  VertexId insert_in(FaceId t, const Vec2& p);
  // Splits an edge at p and returns the new vertex. pre: p lies on the edge, exactly.
  VertexId split_edge(PlaneEdge edge, const Vec2& p);

  // Makes a-b an edge, with these marks on its left and right. Returns false, and changes nothing,
  // if a-b crosses a segment or passes through a vertex. pre: a != b.
  bool constrain(VertexId a, VertexId b, Side left, Side right);

  // Finds the triangle that holds p, on a walk from `from` over edges that are no segments. If the
  // walk ends at a segment or a side of the rectangle, finds that edge instead.
  struct Place {
    FaceId t = kNoId;                    // holds p, unless kNoId
    std::optional<PlaneEdge> blocked{};  // also absent if the walk finds nothing
  };
  Place locate(const Vec2& p, FaceId from) const;

  // Returns the edge a -> b, as its left triangle runs along it; t == kNoId if there is none.
  PlaneEdge find_edge(VertexId a, VertexId b) const;

  // Calls visit(t, i) for the triangles t at v, until it returns false. v is corner i of t.
  template <class Visit>
  void circulate(VertexId v, Visit&& visit) const {
    const FaceId start = around_[v];
    FaceId t = start;
    do {
      const int i = corner(t, v);
      if (!visit(t, i)) return;
      t = triangles_[t].n[(i + 1) % 3];
    } while (t != kNoId && t != start);
    if (t == start) return;
    for (t = triangles_[start].n[(corner(start, v) + 2) % 3]; t != kNoId;) {
      const int i = corner(t, v);
      if (!visit(t, i)) return;
      t = triangles_[t].n[(i + 2) % 3];
    }
  }

 private:
  int corner(FaceId t, VertexId v) const {
    const auto& c = triangles_[t].v;
    return c[0] == v ? 0 : c[1] == v ? 1 : 2;
  }
  int turn(VertexId a, VertexId b, VertexId c) const;
  bool may_flip(FaceId t, int i) const {
    return triangles_[t].n[i] != kNoId && triangles_[t].side[i] == Side::none;
  }
  // Returns the corner across the edge opposite corner i of t.
  VertexId opposite_corner(FaceId t, int i) const;
  bool is_delaunay(FaceId t, int i) const;
  void split_triangle(FaceId t, VertexId v);
  void split_at(PlaneEdge edge, VertexId v);
  void link(FaceId t, int i, FaceId g, FaceId g_was);
  void flip(FaceId t, int i);
  void legalize_around(VertexId v);
  void legalize(std::vector<std::pair<VertexId, VertexId>> edges);

  std::vector<Vec2> points_;
  std::vector<FaceId> around_;  // for every vertex, a triangle at it
  std::vector<PlaneTriangle> triangles_;
  FaceId last_ = 0;
};

}  // namespace deliso
