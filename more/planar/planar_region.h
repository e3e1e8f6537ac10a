// SPDX-License-Identifier: MIT
// The region of a rectangle on the inside of the segments of a constrained triangulation, and its
// Delaunay refinement (Chew 1989; Ruppert 1995; Shewchuk 2002).
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "more/planar/constrained_triangulation.h"

namespace deliso {

// Sets `inside` on all triangles, by flooding from the sides of segments: no sample decides.
// Without any segment, all become `default_inside`. Returns false if a piece is both inside and
// outside.
bool mark_inside(ConstrainedTriangulation& triangulation, bool default_inside);

// Inserts circumcenters into the inside until every triangle there has r/l <= lambda, with r its
// circumradius and l its shortest edge. Segments are not split: a point in the diametral circle of
// one is refused. Sides of the rectangle are split by the caller, since other rectangles may share
// them: run() requests the splits and returns. Triangles as small as rounding are left as they are.
class RegionRefiner {
 public:
  // Keeps a reference. pre: lambda >= 1; below, refinement need not terminate.
  RegionRefiner(ConstrainedTriangulation& triangulation, double lambda);

  // Refines as far as possible without splitting a side. Appends the sides to be split to `sides`,
  // each once, in the direction in which the inside runs along it.
  void run(std::vector<std::pair<VertexId, VertexId>>& sides);
  // The answers to run()'s requests. Either v now splits the side, or the side must stay: then the
  // triangles that requested the split stay as they are.
  void add_split(VertexId v);
  void keep_side(VertexId a, VertexId b) { kept_sides_.emplace_back(a, b); }

  std::size_t inserted() const { return inserted_; }
  // Returns how many triangles stay bad because their circumcenter came too close to a segment.
  std::size_t refused() const { return refused_; }

 private:
  struct Bad {
    double ratio2;  // (r/l)^2
    FaceId t;
    std::array<VertexId, 3> v;
    bool operator<(const Bad& other) const {
      return ratio2 != other.ratio2 ? ratio2 < other.ratio2 : t > other.t;
    }
  };
  void enqueue_if_bad(FaceId t);
  void enqueue_bad_around(VertexId v);
  void refine(const Bad& bad);
  bool is_side(FaceId t, int i) const { return triangulation_.triangle(t).n[i] == kNoId; }
  bool is_kept(VertexId a, VertexId b) const;
  // Requests a split of side i of t. Returns false if it is a segment or must stay.
  bool request_split(FaceId t, int i);
  bool in_circle_about(FaceId t, int i, const Vec2& p) const;

  ConstrainedTriangulation& triangulation_;
  double lambda2_;
  double min_radius2_;        // squared; smaller triangles are left
  std::vector<Bad> queue_;    // a heap
  std::vector<Bad> waiting_;  // until sides are split
  std::vector<std::pair<VertexId, VertexId>> requested_sides_, kept_sides_;
  std::vector<FaceId> cavity_;
  std::size_t inserted_ = 0, refused_ = 0;
};

}  // namespace deliso
