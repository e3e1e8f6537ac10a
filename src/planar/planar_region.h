// SPDX-License-Identifier: MIT
// The part of a rectangle that lies on the inside of the segments of a constrained triangulation,
// and its Delaunay refinement (Chew 1989; Ruppert 1995; Shewchuk 2002).
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "planar/constrained_triangulation.h"

namespace deliso {

// Sets `inside` on all triangles, by flooding from the sides of segments: no sample decides. Where
// there is no segment at all, `otherwise` does. False when a part is both inside and outside.
bool mark_inside(ConstrainedTriangulation& triangulation, bool otherwise);

// Puts circumcenters into the inside until every triangle there has r/l <= lambda, r its
// circumradius and l its shortest edge. Segments are kept whole: a point in the circle about one is
// refused. Sides of the rectangle are the caller's to split, since others may share them: run()
// says which are to be, and stops there. Triangles as small as rounding are left as they are.
class RegionRefiner {
 public:
  // Keeps a reference. pre: lambda >= 1, or refinement need not end.
  RegionRefiner(ConstrainedTriangulation& triangulation, double lambda);

  // Works off what can be without splitting a side; the sides to be split, each as the inside runs
  // along it, no two alike, are appended to `sides`.
  void run(std::vector<std::pair<VertexId, VertexId>>& sides);
  // The answer to each of run()'s wishes: v now splits the side, or it is to be left alone, that
  // is, the triangles that asked for it stay as they are.
  void was_split(VertexId v);
  void refuse_side(VertexId a, VertexId b) { whole_.emplace_back(a, b); }

  std::size_t inserted() const { return inserted_; }
  // Triangles given up because their circumcenter came too close to a segment.
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
  void judge(FaceId t);
  void judge_around(VertexId v);
  void refine(const Bad& bad);
  bool is_side(FaceId t, int i) const { return triangulation_.triangle(t).n[i] == kNoId; }
  bool is_whole(VertexId a, VertexId b) const;
  // Asks for side i of t to be split; false when it is to be left alone.
  bool ask_for(FaceId t, int i);
  bool in_circle_about(FaceId t, int i, const Vec2& p) const;

  ConstrainedTriangulation& triangulation_;
  double lambda2_;
  double smallest2_;          // the circumradius, squared
  std::vector<Bad> queue_;    // a heap
  std::vector<Bad> waiting_;  // for sides to be split
  std::vector<std::pair<VertexId, VertexId>> wanted_, whole_;
  std::vector<FaceId> cavity_;
  std::size_t inserted_ = 0, refused_ = 0;
};

}  // namespace deliso
