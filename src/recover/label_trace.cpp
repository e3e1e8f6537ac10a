// SPDX-License-Identifier: MIT
#include "recover/label_trace.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/triangle.h"

namespace deliso {
namespace {

// Three regions meet there.
bool is_dual(const Triangle& labels) {
  return labels[0] != kNoId && labels[0] != labels[1] && labels[1] != labels[2] &&
         labels[2] != labels[0];
}

Reason reason_of(Violation violation) {
  switch (violation) {
    case Violation::region:
      return Reason::region;
    case Violation::interface:
      return Reason::interface;
    case Violation::triple:
      return Reason::triple;
    case Violation::boundary:
      return Reason::boundary;
    case Violation::none:
      break;
  }
  return Reason::protrusion;
}

}  // namespace

LabelTrace::LabelTrace(Trace& trace, const ContourMesh& contour, const ContourGraph& graph,
                       const Labels& labels, const Triangulation& triangulation, const Box3& box,
                       const Report& report)
    : contour_(contour),
      graph_(graph),
      labels_(labels),
      triangulation_(triangulation),
      cells_(trace, box, report),
      label_(labels.all().begin(), labels.all().end()) {
  cells_.number_vertices(triangulation);
  TraceEvent& event =
      trace.asks(trace_code(Routine::init_triangulation), trace_code(Reason::beginning));
  for (const Triangle& t : contour.triangles) {
    const Triangle sites{label_[t[0]], label_[t[1]], label_[t[2]]};
    if (is_dual(sites)) event.added.push_back(cells_.number(sites));
  }
  event.value = static_cast<double>(event.added.size());
  cells_.record(TraceOutcome::done);
  if (!shows_contour()) return;
  TraceArrays& arrays = trace.arrays();
  for (const Vec3& p : contour.points) {
    for (int axis = 0; axis < 3; ++axis) {
      arrays.contour_points.push_back(static_cast<float>(p[axis]));
    }
  }
  for (const Triangle& t : contour.triangles) {
    arrays.contour_triangles.insert(arrays.contour_triangles.end(), t.begin(), t.end());
  }
  for (const VertexId s : label_) {
    arrays.contour_label.push_back(s == kNoId ? kNoId : cells_.number(s));
  }
}

void LabelTrace::asks(Routine routine, Reason reason, VertexId site, VertexId v) {
  const double value = v == kNoId ? 0 : std::sqrt(labels_.distance2_to_site(v));
  TraceEvent& event = cells_.trace().asks(trace_code(routine), trace_code(reason), value);
  if (site != kNoId) event.caller[0] = cells_.number(site);
}

void LabelTrace::verdict_asks(const Verdict& verdict, VertexId site,
                              std::span<const DualFacet> facets, double fingers) {
  if (cells_.trace().is_full()) return;
  if (verdict.violation != Violation::none) {
    return asks(Routine::certify, reason_of(verdict.violation), site, verdict.insert);
  }
  asks(Routine::find_protrusions, Reason::protrusion, site, verdict.insert);
  const Triangulation& t = triangulation_;
  const Vec3& p = contour_.points[verdict.insert];
  double nearest2 = labels_.distance2_to_site(verdict.insert);
  for (const DualFacet& facet : facets) {
    const auto& [a, b, c] = facet.sites;
    nearest2 = std::min(nearest2, distance2_to_triangle(p, t.point(a), t.point(b), t.point(c)));
  }
  cells_.trace().event().value = std::sqrt(nearest2) / fingers;
}

void LabelTrace::begin_insertion(const Vec3& p, const ConflictZone& zone) {
  if (!cells_.trace().is_full()) cells_.add_zone(triangulation_, zone, p);
}

void LabelTrace::added(VertexId site) {
  if (cells_.trace().is_full()) return cells_.record(TraceOutcome::done);
  cells_.number_vertices(triangulation_);
  TraceEvent& event = cells_.trace().event();
  event.vertex = cells_.number(site);
  const auto is_taken = [&](VertexId v) { return labels_.label(v) == site && label_[v] != site; };
  // Every triangle of T with vertices that are taken, at the first of these.
  for (const VertexId v : labels_.region(site)) {
    const std::span<const VertexId> ring = graph_.ring(v);
    const std::size_t triangles = ring.size() - (graph_.chain_next(v) != kNoId);
    for (std::size_t n = 0; n < triangles; ++n) {
      const VertexId u = ring[n], w = ring[n + 1 < ring.size() ? n + 1 : 0];
      if ((u < v && is_taken(u)) || (w < v && is_taken(w))) continue;
      const Triangle before{label_[v], label_[u], label_[w]};
      const Triangle after{site, labels_.label(u), labels_.label(w)};
      if (is_dual(before)) event.removed.push_back(cells_.number(before));
      if (is_dual(after)) event.added.push_back(cells_.number(after));
    }
  }
  for (const VertexId v : labels_.region(site)) {
    if (shows_contour()) event.relabel.push_back({v, event.vertex});
    label_[v] = site;
  }
  cells_.record(TraceOutcome::done);
}

}  // namespace deliso
