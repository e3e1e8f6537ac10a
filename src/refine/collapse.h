// SPDX-License-Identifier: MIT
// Needles collapsed: Stage 1 may hand over vertices very close to each other (the curve on the box
// and the surface inside are sampled by different rules, crossings near a sample lie as near each
// other as they like), and no insertion mends what a short edge makes. One of its ends is merged
// into the other. Only vertices of Stage 1 go, so there is an end to it.
#pragma once

#include "refine/judge.h"
#include "refine/replace_disk.h"
#include "surface/boundary.h"

namespace deliso {

class Collapser {
 public:
  // Keeps references. The first `of_stage1` vertices are those of Stage 1.
  Collapser(SurfaceMesh& surface_mesh, DiskReplacer& replacer, const Judge& judge,
            const Isosurface& surface, const BoundaryCurves& curves, const Parameters& parameters,
            std::size_t of_stage1);

  // Collapses the shortest edge of f when f has r/l over its limit and the edge is shorter than
  // r_min, unless the worst r/l there would more than double.
  bool collapse(FaceId f);
  // Merges a corner of f into a neighbour, whatever the distance, where that leaves fewer facets
  // around it that no insertion mends.
  bool take_out_corner(FaceId f);
  // Merges v, a corner of f on the boundary, into a neighbour there, whatever becomes of shapes; at
  // any cost: though edges turn sharply, and facets find no surface point.
  bool take_out(FaceId f, VertexId v, bool at_any_cost);
  std::span<const FaceId> created() const { return change_.created; }

 private:
  // `gains()` is asked last, as in DiskReplacer::replace().
  template <class Gains>
  std::optional<Refusal> merge(FaceId f, VertexId from, VertexId to, Gains&& gains);
  bool may_go(VertexId v) const;
  bool joins_on_box(VertexId v, VertexId w) const;
  double worst_ratio(std::span<const Triangle> facets) const;

  SurfaceMesh& s_;
  const TriMesh& mesh_;
  DiskReplacer& replacer_;
  const Judge& judge_;
  const Box3 box_;
  const BoundaryCurves& curves_;
  const Parameters& parameters_;
  std::size_t of_stage1_;
  double least_cosine_ = kSharpest;
  Change change_;
};

}  // namespace deliso
