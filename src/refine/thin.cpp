// SPDX-License-Identifier: MIT
#include "refine/thin.h"

#include <algorithm>

#include "refine/operations.h"

namespace deliso {

Thinning::Thinning(Refinement& r, std::span<const VertexId> vertices)
    : r_(r),
      test_(r.surface.volume(), r.surface.kappa(), r.parameters,
            r.parameters.refinement[Criterion::distance]),
      state_(r.mesh.points.size(), State::stays),
      facet_(r.mesh.points.size(), kNoId) {
  for (FaceId f = 0; f < r.mesh.faces.size(); ++f) {
    if (is_dead(r.mesh.faces[f]) || r.is_frozen(f)) continue;
    for (const VertexId v : r.mesh.faces[f].v) facet_[v] = f;
  }
  for (const VertexId v : vertices) wait(v);
  for (VertexId v(r.inserted); v < r.mesh.points.size(); ++v) wait(v);
}

void Thinning::wait(VertexId v) {
  if (facet_[v] == kNoId) return;
  waiting_.push_back(v);
  state_[v] = State::waits;
}

std::optional<Refusal> Thinning::remove_next() {
  const VertexId v = waiting_.back();
  waiting_.pop_back();
  const Question question(r_, v, Reason::unneeded);
  const auto refusal = remove(v);
  r_.done(Operation::removal, refusal);
  if (refusal) {
    state_[v] = State::refused;
    return refusal;
  }
  for (const FaceId f : r_.created()) {
    for (const VertexId w : r_.mesh.faces[f].v) {
      facet_[w] = f;
      if (state_[w] == State::refused) wait(w);
    }
  }
  return std::nullopt;
}

std::optional<Refusal> Thinning::remove(VertexId v) {
  const BoundaryChain& chain = r_.s.chain;
  if (chain.is_boundary(v) &&
      (!r_.s.may_remove(v, r_.curves) || leaves_curve(r_, chain.previous(v), chain.next(v)))) {
    return Refusal::boundary;
  }
  if (!ring_.walk(r_.mesh, facet_[v], v, chain.is_boundary(v)) || ring_.size < 3) {
    return Refusal::not_a_disk;
  }
  const std::span star = std::span(ring_.star).first(static_cast<std::size_t>(ring_.facets));
  if (std::ranges::any_of(star, [&](FaceId f) { return r_.is_frozen(f); })) return Refusal::frozen;
  ring_.project();
  if (!hole_.fill(ring_, test_)) return Refusal::no_gain;
  const Cavity* cavity = r_.open(star);
  if (!cavity) return Refusal::not_a_disk;
  std::vector<Triangle> facets;
  for (int n = 0; n < hole_.size(); ++n) {
    const auto& [i, j, k] = hole_.facet(n).corner;
    facets.push_back({ring_.vertex[i], ring_.vertex[j], ring_.vertex[k]});
  }
  return r_.make(cavity->fill(facets, Gates{}), [&](const Replacement& c) {
    if (c.duals.empty()) return true;
    const Triangle& last = facets[c.duals.size() - 1];
    return r_.violation(last, c.duals.back()) <= 1 && r_.is_delaunay(last, c.duals.back(), v);
  });
}

}  // namespace deliso
