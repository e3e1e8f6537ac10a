// SPDX-License-Identifier: MIT
// The operations of Stage 2. Each proposes replacements of a disk (refine/refinement.h), until one
// is done, and counts the outcome; not where there was nothing to try. It returns nullopt if a
// replacement was done, else the reason of the refusal: the operation's own, or the gate's that
// refused. After a success Refinement::created() are the new facets. The functions that return no
// refusal are what the operations ask.
#pragma once

#include <optional>
#include <span>

#include "refine/refinement.h"

namespace deliso {

// Inserts p, a point of Sigma (paper §2.2.2, Figure 3). E: the facets whose surface balls hold p,
// found by a walk from `start`. The cone D from p over E's boundary replaces E. If p encroaches
// upon a boundary edge, splits that edge instead (paper §5). Counts under `operation`. Unlike in
// the paper, E must be a disk with all its vertices on its boundary.
std::optional<Refusal> insert_point(Refinement& r, Operation operation, FaceId start,
                                    const Vec3& p);

// Replaces the facets by the cone from p, as insert_point() does, and counts nothing. `split`: the
// boundary edge that p splits.
std::optional<Refusal> replace_by_cone(Refinement& r, std::span<const FaceId> facets, const Vec3& p,
                                       const BoundarySplit* split = nullptr);

// Returns the longest edge of the cavity on the mesh's boundary whose diametral ball holds p.
std::optional<EdgeRef> encroached_edge(const Refinement& r, std::span<const FaceId> cavity,
                                       const Vec3& p);

// Inserts the middle of the arc of a boundary edge. pre: no facet is across the edge.
std::optional<Refusal> split_boundary_edge(Refinement& r, EdgeRef edge);

// True if the arc between boundary vertices, from a to b along the chain, is further from the edge
// ab than Sigma may be from a facet.
bool leaves_curve(const Refinement& r, VertexId a, VertexId b);
// The same for a boundary edge; false if its arc is fixed.
bool leaves_curve(const Refinement& r, EdgeRef edge);

// True if neither facet at the edge of f opposite its corner i holds the other's corner in its
// surface ball. An edge with one facet is Delaunay.
bool is_edge_delaunay(const Refinement& r, FaceId f, int i);

// Flips the edge of f opposite its corner i, if it is not Delaunay. After the flip it must
// be, and the flip must lower the sum of the two radii. In the plane every Delaunay flip does
// (Musin 1997). On a surface it need not, and flips could repeat forever.
std::optional<Refusal> flip_if_not_delaunay(Refinement& r, FaceId f, int i);

// Collapses the shortest edge of f if the r/l of f is over its limit and the edge is shorter than
// r_min. The worst r/l there must not rise. Stage 1 can leave vertices very close to each
// other, and no insertion removes a short edge. Only vertices before Refinement::inserted are
// removed, so collapses end.
std::optional<Refusal> collapse_short_edge(Refinement& r, FaceId f);

// Merges `from`, a corner of f, into its neighbor `to`, and counts nothing. Refused if the chain
// needs `from`, or if `from` is on the boundary and `to` is not next to it there.
std::optional<Refusal> merge_corner(Refinement& r, FaceId f, VertexId from, VertexId to,
                                    const Gates& gates,
                                    const Refinement::Accept& accept = Refinement::always);

// Moves a corner of f along Sigma to the first of some places where the facets around it, and those
// across them, cost less. Where every insertion is refused and no flip helps, the places of
// vertices are at fault (Tournois, Wormser, Alliez and Desbrun 2009). Vertices on the boundary
// stay.
std::optional<Refusal> move_corner(Refinement& r, FaceId f);

}  // namespace deliso
