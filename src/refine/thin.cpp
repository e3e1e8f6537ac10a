// SPDX-License-Identifier: MIT
#include "refine/thin.h"

#include <algorithm>
#include <utility>

#include "base/triangle.h"
#include "refine/operations.h"

namespace deliso {

Thinning::Thinning(Refinement& r, std::span<const VertexId> vertices)
    : r_(r), state_(r.mesh.points.size(), State::stays), facet_(r.mesh.points.size(), kNoId) {
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
      (!may_remove(r_, v) || leaves_curve(r_, chain.previous(v), chain.next(v)))) {
    return Refusal::boundary;
  }
  walk_around(v);
  if (std::ranges::any_of(star_, [&](FaceId f) { return r_.is_frozen(f); })) return Refusal::frozen;
  filling_.clear();
  if (!fill(0, ring_.size() - 1)) return Refusal::no_gain;
  if (filling_.empty()) return Refusal::not_a_disk;

  // The largest facet is the first to miss the bound on the distance.
  std::ranges::sort(filling_, std::ranges::greater(), &NewFacet::radius2);
  const double r_min = r_.parameters.r_min;
  const double limit = r_.parameters.refinement[Criterion::distance];
  double distance2 = kNotAsked;
  for (const NewFacet& f : filling_) {
    const auto& [a, b, d] = f.corners;
    if (f.radius2 > r_min * r_min && !has_surface_near(f.corners)) return Refusal::no_gain;
    distance2 = std::min(distance2,
                         distance2_to_triangle(r_.point(v), r_.point(a), r_.point(b), r_.point(d)));
  }
  if (distance2 > limit * limit) return Refusal::uncovers;
  Proposal* c = r_.propose(star_);
  if (!c) return Refusal::not_a_disk;
  c->duals.clear();
  for (const NewFacet& f : filling_) {
    const auto& [a, b, d] = f.corners;
    const Dual dual =
        r_.finder.dual(r_.point(a), r_.point(b), r_.point(d), r_.report.searches_refine);
    if (r_.violation(f.corners, dual) > 1 || !r_.is_delaunay(f.corners, dual, v)) {
      return Refusal::no_gain;
    }
    c->in.facets.push_back(f.corners);
    c->duals.push_back(dual);
  }
  c->knows_duals = true;
  return r_.replace();
}

void Thinning::walk_around(VertexId v) {
  const auto& faces = r_.mesh.faces;
  star_.clear();
  ring_.clear();
  normal_ = {};
  FaceId first = facet_[v];
  if (r_.s.chain.is_boundary(v)) {
    const auto before = [&](FaceId f) { return faces[f].n[(corner_index(faces[f], v) + 2) % 3]; };
    while (before(first) != kNoId) first = before(first);
  }
  for (FaceId f = first; star_.empty() || f != first;) {
    const Face& face = faces[f];
    const int i = corner_index(face, v);
    star_.push_back(f);
    ring_.push_back(face.v[(i + 1) % 3]);
    normal_ = normal_ + r_.normal(face.v);
    f = face.n[(i + 1) % 3];
    if (f != kNoId) continue;
    ring_.push_back(face.v[(i + 2) % 3]);
    return;
  }
}

bool Thinning::fill(std::size_t i, std::size_t j) {
  if (j - i < 2) return true;
  const bool is_new_edge = j - i + 1 < ring_.size();
  if (is_new_edge && joins_on_box(r_, ring_[i], ring_[j])) return false;
  // The Delaunay triangle at an edge is that whose third corner sees it at the largest angle.
  const Vec3 &a = r_.point(ring_[i]), &b = r_.point(ring_[j]);
  std::size_t third = i;
  double cotangent = kNotAsked;
  for (std::size_t k = i + 1; k < j; ++k) {
    const Vec3 u = a - r_.point(ring_[k]), w = b - r_.point(ring_[k]), n = cross(w, u);
    if (!(dot(n, normal_) > 0)) continue;
    const double at_k = dot(u, w) / length(n);
    if (at_k < cotangent) cotangent = at_k, third = k;
  }
  if (third == i) return false;
  const Vec3& c = r_.point(ring_[third]);
  const double ratio2 = radius_ratio2(a, b, c),
               limit = r_.parameters.refinement[Criterion::r_over_l];
  if (ratio2 > limit * limit) return false;
  filling_.push_back({{ring_[i], ring_[third], ring_[j]}, ratio2 * shortest_edge2(a, b, c)});
  return fill(i, third) && fill(third, j);
}

bool Thinning::has_surface_near(const Triangle& facet) const {
  const double limit = r_.parameters.refinement[Criterion::distance];
  if (!(limit < kNotAsked)) return true;
  const Vec3 &a = r_.point(facet[0]), &b = r_.point(facet[1]), &c = r_.point(facet[2]);
  const Vec3 normal = area_normal(a, b, c), center = circumcenter(a, b, c);
  const Vec3 step = limit / length(normal) * normal;
  const auto is_inside = [&](const Vec3& p) {
    return r_.surface.volume().value(p) >= r_.surface.kappa();
  };
  return is_inside(center - step) && !is_inside(center + step);
}

}  // namespace deliso
