// SPDX-License-Identifier: MIT
// How bodies divide a face between four samples: the arcs between them, and their regions. The
// corners 0 to 3 go around the face; edge n is from corner n to the next. Where the bodies of
// neighbors differ at all four edges, those of one diagonal's corners meet in the middle: the pair
// that has the body of the face's middle. If they are the same body, their regions are one.
//
// The arcs end in points of edges, and in up to two points where three bodies meet. With one such
// point, wherever it is in the face, all is seen from it. Two lie on the two sides of the diagonal
// whose corners meet. Then arcs, and the triangles below, do not overlap.
#pragma once

#include <array>
#include <vector>

#include "more/bodies/partition.h"

namespace deliso {

// Points of a face, by number.
struct FacePlaces {
  std::array<int, 4> corner, edge;  // edge[n]: where corner n and the next are of two bodies
  std::array<int, 2> meeting;       // where three bodies meet
  int middle;                       // in the middle of a region with five or more corners
};

// An arc, and the bodies beside it as seen from the side from which corners are in
// counter-clockwise order.
struct FaceArc {
  int from, to;
  BodyId left, right;
};

struct FaceTriangle {
  std::array<int, 3> v;  // counter-clockwise
  BodyId body;
};

class FaceRegions {
 public:
  // `diagonal`: 0 or 1, the corners that meet if neighbors differ at all edges.
  FaceRegions(const std::array<BodyId, 4>& bodies, int diagonal, const FacePlaces& places);

  const std::vector<FaceArc>& arcs() const { return arcs_; }
  const std::vector<FaceTriangle>& triangles() const { return triangles_; }
  // The corners of the region with a point in its middle; empty: none has.
  const std::vector<int>& around_middle() const { return around_middle_; }
  // How many points there are where three bodies meet.
  int meetings() const { return meetings_; }
  // The corners that meet in the middle, if neighbors differ at all edges; else -1.
  int diagonal() const { return diagonal_; }

 private:
  BodyId body(int n) const { return bodies_[n % 4]; }
  int corner(int n) const { return at_.corner[n % 4]; }
  int edge(int n) const { return at_.edge[n % 4]; }
  void add_arc(int from, int to, int left, int right) {
    arcs_.push_back({from, to, body(left), body(right)});
  }
  void add(int a, int b, int c, int of) { triangles_.push_back({{a, b, c}, body(of)}); }
  void add_polygon(const std::vector<int>& p, int of);
  void add_star();
  void add_contact(int d);

  std::array<BodyId, 4> bodies_;
  FacePlaces at_;
  int meetings_ = 0, diagonal_ = -1;
  std::vector<FaceArc> arcs_;
  std::vector<FaceTriangle> triangles_;
  std::vector<int> around_middle_;
};

}  // namespace deliso
