// SPDX-License-Identifier: MIT
// What Stage 2 tries on a facet: each function proposes one replacement of a disk (refinement.h),
// counts what came of it, and returns nothing when it was done, else the test that refused it.
// After a success Refinement::created() are the new facets.
#pragma once

#include <optional>

#include "refine/refinement.h"

namespace deliso {

// Insertion (paper §2.2.2, Figure 3). The facets whose surface balls hold p, a point of Sigma,
// found by walking from `start`, are the disk E; the cone D from p over E's boundary takes its
// place. A p that comes near a boundary edge splits that edge instead (paper §5). Counts under
// `rung`. Differs from the paper in that E must be a disk with all its vertices on its boundary.
std::optional<Refusal> insert_point(Refinement& r, Rung rung, FaceId start, const Vec3& p);

// Inserts the middle of the arc that a boundary edge stands for. pre: no facet across it.
std::optional<Refusal> split_boundary_edge(Refinement& r, EdgeRef edge);

// True if that arc runs further from the boundary edge than facets may run from Sigma.
bool leaves_curve(const Refinement& r, EdgeRef edge);

// Flips the edge of f opposite its corner i, if it is not Delaunay: one of the two facets there has
// the other's corner in its ball, and the two across the other diagonal have not. Only if that
// lowers the sum of the balls' radii: in the plane every Delaunay flip does (Musin 1997), on a
// surface it need not, and flips could repeat without end.
std::optional<Refusal> flip_if_not_delaunay(Refinement& r, FaceId f, int i);

// Collapses the shortest edge of f when f has r/l over its limit and the edge is shorter than
// r_min, unless the worst r/l there would rise. Stage 1 may hand over vertices very close to each
// other, and no insertion mends what a short edge makes. Only vertices go that were there from the
// first, so this ends.
std::optional<Refusal> collapse_short_edge(Refinement& r, FaceId f);

// Proposes to merge `from`, a corner of f, into its neighbor `to`: sets r.change. Refused where the
// mesh or the chain cannot do without `from`.
std::optional<Refusal> propose_merge(Refinement& r, FaceId f, VertexId from, VertexId to,
                                     double least_cosine = kSharpestFold);

// Does what propose_merge() proposed, if accept() holds.
template <class Accept>
std::optional<Refusal> merge_vertex(Refinement& r, VertexId from, Accept&& accept) {
  const std::optional<Refusal> refusal = r.replace(r.change, accept);
  if (!refusal && r.s.chain.is_boundary(from)) r.s.chain.remove(from);
  return refusal;
}

// Moves a corner of f along Sigma to where the facets around it, and those across them, cost least.
// Where every insertion is refused and no flip helps, it is the vertices that stand badly
// (Tournois, Wormser, Alliez and Desbrun 2009). Vertices on the boundary stay.
std::optional<Refusal> move_corner(Refinement& r, FaceId f);

}  // namespace deliso
