// SPDX-License-Identifier: MIT
#include "paper/restricted_trace.h"

#include <utility>

#include "base/triangle.h"
#include "trace/trace.h"

namespace deliso {
namespace {

constexpr Triangle kNone{kNoId, kNoId, kNoId};

}  // namespace

TraceEvent& RestrictedTrace::asks(Routine routine, std::uint8_t reason, double value) {
  outcome_ = TraceOutcome::done;
  return cells_.trace().asks(trace_code(routine), reason, value);
}

void RestrictedTrace::tell_facet(RecordId r, TraceEvent& event) const {
  const RestrictedDelaunay& restricted = *restricted_;
  const FacetDual dual = facet_dual(restricted.triangulation(), restricted.facet(r));
  const Range range =
      clip(dual.center, dual.normal, {dual.t_lo, dual.t_hi}, restricted.surface().volume().box());
  event.edge = {dual.at(range.lo), dual.at(range.hi)};
  const std::span<const Vec3> hits = restricted.effective_hits(r);
  event.hits.assign(hits.begin(), hits.end());
  const Vec3 x = restricted.surface_point(r);
  const Vec3& a = restricted.triangulation().point(restricted.triangle(r)[0]);
  event.ball = {x, distance(x, a)};
}

void RestrictedTrace::boundary_asks(VertexId from, VertexId to) {
  const Triangulation& t = restricted_->triangulation();
  TraceEvent& event = asks(Routine::protect_boundary, trace_code(Reason::encroached),
                           distance(t.point(from), t.point(to)));
  event.caller = {cells_.number(from), cells_.number(to), kNoId};
}

void RestrictedTrace::edge_asks(RecordId r) {
  const auto hits = restricted_->effective_hits(r).size();
  TraceEvent& event =
      asks(Routine::multi_intersect, trace_code(Reason::several_hits), static_cast<double>(hits));
  event.caller = cells_.number(restricted_->triangle(r));
  tell_facet(r, event);
}

void RestrictedTrace::star_asks(VertexId q, bool on_boundary, std::span<const RecordId> star,
                                RecordId furthest) {
  std::vector<Triangle> facets;
  for (const RecordId r : star) facets.push_back(restricted_->triangle(r));
  const auto reason = [&] {
    switch (classify_star(q, facets)) {
      case Star::empty:
        return Reason::star_empty;
      case Star::disk:
      case Star::half_disk:
        return on_boundary ? Reason::star_off_chain : Reason::star_half_disk;
      case Star::singular:
        break;
    }
    return Reason::star_singular;
  }();
  TraceEvent& event =
      asks(Routine::extract_manifold, trace_code(reason), static_cast<double>(facets.size()));
  event.caller[0] = cells_.number(q);
  for (const Triangle& facet : facets) event.star.push_back(cells_.number(facet));
  if (furthest != kNoId) tell_facet(furthest, event);
}

void RestrictedTrace::shape_asks(RecordId r, const FacetShape& shape, const Criteria& criteria) {
  TraceEvent& event = asks(Routine::approximate_geom, trace_code(worst_criterion(shape, criteria)),
                           violation(shape, criteria));
  event.caller = cells_.number(restricted_->triangle(r));
  tell_facet(r, event);
}

void RestrictedTrace::begin(const RestrictedDelaunay& restricted) {
  restricted_ = &restricted;
  cells_.number_vertices(restricted.triangulation());
  TraceEvent& event = asks(Routine::init_triangulation, trace_code(Reason::beginning), 0);
  for (const RecordId r : restricted.created()) show(r);
  event.value = static_cast<double>(event.added.size());
  cells_.record(TraceOutcome::done);
}

void RestrictedTrace::begin_insertion(const Vec3& p, const ConflictZone& zone) {
  cells_.add_zone(restricted_->triangulation(), zone, p);
}

void RestrictedTrace::gone(RecordId r) {
  if (r >= shown_.size() || shown_[r] == kNone) return;
  cells_.trace().event().removed.push_back(std::exchange(shown_[r], kNone));
}

void RestrictedTrace::show(RecordId r) {
  const RestrictedDelaunay& restricted = *restricted_;
  if (r >= shown_.size()) shown_.resize(r + 1, kNone);
  const bool is_in = restricted.is_live(r) && restricted.is_restricted(r);
  if (!is_in) return gone(r);
  if (shown_[r] != kNone) return;
  const Triangulation& t = restricted.triangulation();
  const Triangle v = restricted.triangle(r);
  const Vec3 normal = area_normal(t.point(v[0]), t.point(v[1]), t.point(v[2]));
  shown_[r] = cells_.number(v);
  if (dot(normal, restricted.surface().gradient(restricted.surface_point(r))) > 0) {
    std::swap(shown_[r][0], shown_[r][1]);
  }
  cells_.trace().event().added.push_back(shown_[r]);
}

void RestrictedTrace::inserted() {
  cells_.number_vertices(restricted_->triangulation());
  cells_.trace().event().vertex =
      cells_.number(static_cast<VertexId>(restricted_->triangulation().vertex_capacity() - 1));
  for (const RecordId r : restricted_->created()) show(r);
  cells_.record(outcome_);
}

void RestrictedTrace::splits(VertexId from, VertexId to) {
  TraceEvent& event = cells_.trace().event();
  if (event.routine == trace_code(Routine::protect_boundary)) {
    event.caller = {cells_.number(from), cells_.number(to), kNoId};
  } else {
    outcome_ = TraceOutcome::split;
  }
}

void RestrictedTrace::ended(TraceOutcome outcome, const Vec3& x) {
  cells_.trace().event().place = x;
  cells_.record(outcome);
}

}  // namespace deliso
