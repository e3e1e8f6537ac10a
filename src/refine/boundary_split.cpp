// SPDX-License-Identifier: MIT
// Boundary edges of the mesh and their arcs (paper §5).
#include <algorithm>
#include <utility>
#include <vector>

#include "refine/operations.h"

namespace deliso {
namespace {

// Shortest boundary edge that is split, as a share of r_min. Where the curve turns sharply at an
// edge of the box, shorter edges would encroach upon each other forever.
constexpr double kShortestBoundaryEdge = 0.25;

// Returns the ends of a chain edge in the order of the chain. Nullopt if the edge is fixed or not
// in the chain.
std::optional<std::pair<VertexId, VertexId>> ends_on_chain(const Refinement& r, EdgeRef edge) {
  const BoundaryChain& chain = r.s.chain;
  const Face& face = r.mesh.faces[edge.face];
  VertexId a = face.v[(edge.index + 1) % 3], b = face.v[(edge.index + 2) % 3];
  if (!chain.is_edge(a, b)) return std::nullopt;
  if (chain.next(a) != b) std::swap(a, b);
  if (r.curves.begins_fixed(chain.place(a))) return std::nullopt;
  return std::pair{a, b};
}

}  // namespace

std::optional<EdgeRef> encroached_edge(const Refinement& r, std::span<const FaceId> cavity,
                                       const Vec3& p) {
  std::optional<EdgeRef> longest;
  double length2 = 0;
  for (const FaceId f : cavity) {
    const Face& face = r.mesh.faces[f];
    for (int i = 0; i < 3; ++i) {
      if (face.n[i] != kNoId) continue;
      const Vec3 &a = r.point(face.v[(i + 1) % 3]), &b = r.point(face.v[(i + 2) % 3]);
      if (distance2(a, b) <= length2 || !in_diametral_ball(a, b, p)) continue;
      longest = {f, i};
      length2 = distance2(a, b);
    }
  }
  return longest;
}

std::optional<Refusal> split_boundary_edge(Refinement& r, EdgeRef edge) {
  const BoundaryChain& chain = r.s.chain;
  if (r.is_frozen(edge.face)) return r.done(Operation::boundary_split, Refusal::frozen);
  const auto ends = ends_on_chain(r, edge);
  const double shortest = kShortestBoundaryEdge * r.parameters.r_min;
  if (!ends || distance2(r.point(ends->first), r.point(ends->second)) < shortest * shortest) {
    return r.done(Operation::boundary_split, Refusal::boundary);
  }
  const auto middle = r.curves.split({chain.place(ends->first), r.point(ends->first)},
                                     {chain.place(ends->second), r.point(ends->second)});
  if (!middle) return r.done(Operation::boundary_split, Refusal::boundary);
  const BoundarySplit split{edge, ends->first, middle->place};
  const std::span<const FaceId> encroached = r.encroached(edge.face, middle->point);
  std::vector<FaceId> cavity(encroached.begin(), encroached.end());
  // An edge of the cone to another vertex in the face of the box would lie there (S3).
  std::erase_if(cavity, [&, box = r.surface.volume().box()](FaceId f) {
    return std::ranges::any_of(r.mesh.faces[f].v, [&](VertexId v) {
      return v != ends->first && v != ends->second && on_one_face(r.point(v), middle->point, box);
    });
  });
  return r.done(Operation::boundary_split, replace_by_cone(r, cavity, middle->point, &split));
}

bool leaves_curve(const Refinement& r, VertexId a, VertexId b) {
  const double radius = 0.5 * distance(r.point(a), r.point(b));
  const Criteria& limit = r.parameters.refinement;
  return radius > r.parameters.r_min &&
         r.curves.sagitta({r.s.chain.place(a), r.point(a)}, {r.s.chain.place(b), r.point(b)}) >
             std::min(limit[Criterion::h_over_r] * radius, limit[Criterion::distance]);
}

bool leaves_curve(const Refinement& r, EdgeRef edge) {
  const auto ends = ends_on_chain(r, edge);
  return ends && leaves_curve(r, ends->first, ends->second);
}

}  // namespace deliso
