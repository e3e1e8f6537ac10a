// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "refine/operations.h"

namespace deliso {
namespace {

// Least distance, in r_min, from a new vertex to a vertex of its cavity. A nearer one would make
// needles. In practice it also ends insertion. That is not proven: other vertices are not tested,
// and moves may bring vertices together (docs/proof.md, Statement 5.1).
constexpr double kMinSpacingRMins = 0.25;

// Sets the cavity E: the facets, connected to `start`, whose surface balls hold p.
void collect_cavity(Refinement& r, FaceId start, const Vec3& p) {
  std::vector<FaceId>& cavity = r.begin_change().cavity;
  cavity.assign(1, start);
  for (std::size_t next = 0; next < cavity.size(); ++next) {
    for (const FaceId g : r.mesh.faces[cavity[next]].n) {
      if (g == kNoId || !r.s.duals[g].holds(p)) continue;
      if (std::ranges::find(cavity, g) == cavity.end()) cavity.push_back(g);
    }
  }
}

// Returns the longest edge of E on the mesh's boundary whose diametral ball holds p.
std::optional<EdgeRef> encroached_edge(const Refinement& r, const Vec3& p) {
  std::optional<EdgeRef> longest;
  double length2 = 0;
  for (const FaceId f : r.change.cavity) {
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

// Replaces E by the cone D. `split`: the boundary edge that p splits, on which D has no facet.
std::optional<Refusal> put_cone(Refinement& r, const Vec3& p, EdgeRef split = {}) {
  if (r.observer) r.observer->work_begins(Activity::insertion, r.report.searches_refine);
  Change& c = r.change;
  if (const auto refusal = r.open_cavity(c)) return refusal;
  if (c.was.inner_vertices() > 0) return Refusal::swallows_vertex;
  const double too_close = kMinSpacingRMins * r.parameters.r_min;
  for (const Disk::BoundaryEdge& edge : c.was.boundary) {
    if (distance2(p, r.point(edge.from)) < too_close * too_close) return Refusal::too_close;
  }
  r.set_cone(c, p, split);
  const auto refusal = r.replace(c, [] { return true; });
  if (refusal) return refusal;
  ++r.report.insertions_refine;
  if (r.observer) r.observer->work_ends(Activity::insertion, r.report.searches_refine);
  return std::nullopt;
}

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

std::optional<Refusal> insert_point(Refinement& r, Operation operation, FaceId start,
                                    const Vec3& p) {
  collect_cavity(r, start, p);
  if (const auto edge = encroached_edge(r, p)) return split_boundary_edge(r, *edge);
  return r.done(operation, put_cone(r, p));
}

std::optional<Refusal> split_boundary_edge(Refinement& r, EdgeRef edge) {
  BoundaryChain& chain = r.s.chain;
  r.begin_change();
  if (r.is_frozen(edge.face)) return r.done(Operation::boundary_split, Refusal::frozen);
  const auto ends = ends_on_chain(r, edge);
  const double shortest = kShortestBoundaryEdge * r.parameters.r_min;
  if (!ends || distance2(r.point(ends->first), r.point(ends->second)) < shortest * shortest) {
    return r.done(Operation::boundary_split, Refusal::boundary);
  }
  const auto middle = r.curves.split({chain.place(ends->first), r.point(ends->first)},
                                     {chain.place(ends->second), r.point(ends->second)});
  if (!middle) return r.done(Operation::boundary_split, Refusal::boundary);
  collect_cavity(r, edge.face, middle->point);
  const auto refusal = put_cone(r, middle->point, edge);
  if (!refusal) chain.insert_after(ends->first, r.change.vertex, middle->place);
  return r.done(Operation::boundary_split, refusal);
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
