// SPDX-License-Identifier: MIT
// Records the paper's Stage 1: which test asks for an insertion, and its conflict zone. Also the
// facets of Del S|Sigma that are removed and added, oriented with the outside of Sigma in front.
#include <utility>

#include "base/triangle.h"
#include "delaunay/voronoi.h"
#include "view/trace/recorder.h"

namespace deliso {
namespace {

constexpr Triangle kNone{kNoId, kNoId, kNoId};

}  // namespace

void TraceRecorder::tell_facet(RecordId r, TraceEvent& event) const {
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

void TraceRecorder::edge_asked(SiteId from, SiteId to) {
  const Triangulation& t = restricted_->triangulation();
  TraceEvent& event =
      asks(Routine::protect_boundary, Reason::encroached, distance(t.point(from), t.point(to)));
  event.caller = {number(from), number(to), kNoId};
}

void TraceRecorder::star_asked(SiteId q, bool on_boundary, RecordId furthest) {
  std::vector<RecordId> star;
  restricted_->star(q, star);
  std::vector<Triangle> facets;
  facets.reserve(star.size());
  for (const RecordId r : star) facets.push_back(as_mesh_triangle(restricted_->triangle(r)));
  const auto reason = [&] {
    switch (classify_star(VertexId(q.number()), facets)) {
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
  TraceEvent& event = asks(Routine::extract_manifold, reason, static_cast<double>(facets.size()));
  event.caller[0] = number(q);
  for (const Triangle& facet : facets) event.star.push_back(number(facet));
  if (furthest != kNoId) tell_facet(furthest, event);
}

void TraceRecorder::record_asked(RecordId r, Reason reason, double value) {
  TraceEvent& event =
      asks(reason == Reason::several_hits ? Routine::multi_intersect : Routine::approximate_geom,
           reason, value);
  event.caller = number(restricted_->triangle(r));
  tell_facet(r, event);
}

void TraceRecorder::restricted_ready(const RestrictedDelaunay& restricted) {
  restricted_ = &restricted;
  box_ = restricted.surface().volume().box();
  number_vertices();
  TraceEvent& event = asks(Routine::init_triangulation, Reason::beginning, 0);
  for (const RecordId r : restricted.created()) show(r);
  event.value = static_cast<double>(event.added.size());
  record(TraceOutcome::done);
}

void TraceRecorder::record_gone(RecordId r) {
  if (r >= shown_.size() || shown_[r] == kNone) return;
  trace_.event().removed.push_back(std::exchange(shown_[r], kNone));
}

void TraceRecorder::show(RecordId r) {
  const RestrictedDelaunay& restricted = *restricted_;
  if (r >= shown_.size()) shown_.resize(r + 1, kNone);
  if (!restricted.is_restricted(r)) return record_gone(r);
  if (shown_[r] != kNone) return;
  const Triangulation& t = restricted.triangulation();
  const SiteTriangle v = restricted.triangle(r);
  const Vec3 normal = area_normal(t.point(v[0]), t.point(v[1]), t.point(v[2]));
  shown_[r] = number(v);
  if (dot(normal, restricted.surface().gradient(restricted.surface_point(r))) > 0) {
    std::swap(shown_[r][0], shown_[r][1]);
  }
  trace_.event().added.push_back(shown_[r]);
}

void TraceRecorder::show_records(SiteId site) {
  number_vertices();
  trace_.event().vertex = number(site);
  for (const RecordId r : restricted_->created()) show(r);
}

void TraceRecorder::edge_split(SiteId from, SiteId to) {
  TraceEvent& event = trace_.event();
  if (event.routine == trace_code(Routine::protect_boundary)) {
    event.caller = {number(from), number(to), kNoId};
  } else {
    outcome_ = TraceOutcome::split;
  }
}

void TraceRecorder::attempt_ended(Attempt attempt, const Vec3& x) {
  if (attempt != Attempt::forgotten && attempt != Attempt::refused) return;
  trace_.event().place = x;
  record(attempt == Attempt::forgotten ? TraceOutcome::forgotten : TraceOutcome::refused);
}

}  // namespace deliso
