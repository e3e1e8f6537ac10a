// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "base/triangle.h"
#include "refine/operations.h"

namespace deliso {
namespace {

double worst_ratio2(const Refinement& r, std::span<const Triangle> facets) {
  double worst = 0;
  for (const Triangle& v : facets) {
    worst = std::max(worst, radius_ratio2(r.point(v[0]), r.point(v[1]), r.point(v[2])));
  }
  return worst;
}

}  // namespace

std::optional<Refusal> merge_corner(Refinement& r, FaceId f, VertexId from, VertexId to,
                                    const Gates& gates, const Refinement::Accept& accept) {
  const bool on_boundary = r.s.chain.is_boundary(from);
  if (!r.s.may_remove(from, r.curves) || (on_boundary && !r.s.chain.is_edge(from, to))) {
    return Refusal::boundary;
  }
  const Cavity* star = r.open(r.star(f, from));
  if (!star) return Refusal::not_a_disk;
  Proposal merge = star->merge(from, to, gates);
  return merge.facets.empty() ? Refusal::not_a_disk : r.make(std::move(merge), accept);
}

std::optional<Refusal> collapse_short_edge(Refinement& r, FaceId f) {
  const Triangle v = r.mesh.faces[f].v;
  const double limit = r.parameters.refinement[Criterion::r_over_l], limit2 = limit * limit;
  if (worst_ratio2(r, {&v, 1}) <= limit2) return Refusal::no_gain;
  const auto length2 = [&](std::size_t i) {
    return distance2(r.point(v[i]), r.point(v[(i + 1) % 3]));
  };
  const std::size_t shortest =
      std::min({0u, 1u, 2u}, [&](unsigned a, unsigned b) { return length2(a) < length2(b); });
  if (!(length2(shortest) < r.parameters.r_min * r.parameters.r_min)) return Refusal::no_gain;
  VertexId a = v[shortest], b = v[(shortest + 1) % 3];
  const auto is_better = [&](const Replacement& c) {
    if (!c.duals.empty()) return true;  // tested before
    const double before = worst_ratio2(r, c.cavity.disk.facets);
    return before > limit2 && worst_ratio2(r, c.in().facets) <= before;
  };
  // If only one end is on the boundary, the inner end is tried first.
  if (r.s.chain.is_boundary(a)) std::swap(a, b);
  std::optional<Refusal> refusal;
  for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
    refusal =
        from >= r.inserted ? Refusal::boundary : merge_corner(r, f, from, to, Gates{}, is_better);
    if (!r.done(Operation::collapse, refusal)) break;
  }
  return refusal;
}

}  // namespace deliso
