// SPDX-License-Identifier: MIT
#include <algorithm>

#include "refine/operations.h"

namespace deliso {
namespace {

// Least distance, in r_min, from a new vertex to a vertex of its cavity. A nearer one would make
// needles. In practice it also ends insertion. That is not proven: other vertices are not tested,
// and moves may bring vertices together (docs/proof.md, Statement 5.1).
constexpr double kMinSpacingRMins = 0.25;

}  // namespace

std::optional<Refusal> insert_point(Refinement& r, Operation operation, FaceId start,
                                    const Vec3& p) {
  const std::span<const FaceId> cavity = r.encroached(start, p);
  if (const auto edge = encroached_edge(r, cavity, p)) return split_boundary_edge(r, *edge);
  return r.done(operation, replace_by_cone(r, cavity, p));
}

std::optional<Refusal> replace_by_cone(Refinement& r, std::span<const FaceId> facets, const Vec3& p,
                                       const BoundarySplit* split) {
  const Cavity* cavity = r.open(facets);
  if (!cavity) return Refusal::not_a_disk;
  if (cavity->disk.inner_vertices() > 0) return Refusal::swallows_vertex;
  const double too_close = kMinSpacingRMins * r.parameters.r_min;
  for (const Disk::BoundaryEdge& edge : cavity->disk.boundary) {
    if (distance2(p, r.point(edge.from)) < too_close * too_close) return Refusal::too_close;
  }
  const auto refusal = r.make(cavity->cone(p, kInsertionGates, split));
  r.report.insertions_refine += !refusal;
  return refusal;
}

}  // namespace deliso
