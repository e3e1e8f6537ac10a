// SPDX-License-Identifier: MIT
#include "refine/change_trace.h"

#include <cmath>

#include "surface/worst_criterion.h"

namespace deliso {
namespace {

bool is_told(const Trace& trace) {
  return trace.follows_mesh() && !trace.is_full();
}

// By numbers of the trace; kNoId: the new vertex of a try.
Triangle number(Trace& trace, const Triangle& v, VertexId new_vertex = kNoId) {
  Triangle out;
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = v[i] == new_vertex ? kNoId : trace.of_mesh()[v[i]];
  }
  return out;
}

void add(Trace& trace, const Patch& patch, std::vector<Triangle>& out,
         VertexId new_vertex = kNoId) {
  out.clear();
  for (const Triangle& v : patch.facets) out.push_back(number(trace, v, new_vertex));
}

}  // namespace

void trace_facet(Trace& trace, const SurfaceMesh& s, FaceId f, Reason reason, double value) {
  if (!is_told(trace)) return;
  TraceEvent& event = trace.asks(static_cast<std::uint8_t>(Routine::count_), reason, value);
  event.caller = number(trace, s.mesh.faces[f].v);
  const Dual& dual = s.duals[f];
  if (dual.on_surface) event.ball = {dual.center, std::sqrt(dual.radius2)};
}

void trace_criteria(Trace& trace, const SurfaceMesh& s, FaceId f, const FacetShape& shape,
                    const Criteria& criteria) {
  const double pole = s.pole(s.mesh.faces[f].v);
  trace_facet(trace, s, f, worst_criterion(shape, pole, criteria),
              violation(shape, pole, criteria));
}

void trace_not_delaunay(Trace& trace, const SurfaceMesh& s, FaceId f) {
  const Dual& dual = s.duals[f];
  trace_facet(trace, s, f, dual.on_surface ? Reason::not_delaunay : Reason::no_surface_point,
              std::sqrt(dual.radius2));
}

void trace_off_curve(Trace& trace, const SurfaceMesh& s, FaceId f, int side) {
  const Triangle& v = s.mesh.faces[f].v;
  const Vec3 &a = s.mesh.points[v[(side + 1) % 3]], &b = s.mesh.points[v[(side + 2) % 3]];
  trace_facet(trace, s, f, Reason::off_curve, distance(a, b));
}

void trace_disk(Trace& trace, const Change& change) {
  if (!is_told(trace)) return;
  TraceEvent& event = trace.event();
  add(trace, change.was, event.star);
  event.cone.clear();
}

void trace_replacement(Trace& trace, const Change& change, bool is_done) {
  if (!is_told(trace)) return;
  TraceEvent& event = trace.event();
  const bool has_vertex = change.what != Change::Vertex::none;
  if (!is_done) return add(trace, change.in, event.cone, has_vertex ? change.vertex : kNoId);
  event.star.clear();
  event.cone.clear();
  add(trace, change.was, event.removed);
  if (has_vertex) {
    event.vertex = trace.add_vertex(change.place);
    trace.of_mesh().resize(std::max<std::size_t>(trace.of_mesh().size(), change.vertex + 1));
    trace.of_mesh()[change.vertex] = event.vertex;
  }
  add(trace, change.in, event.added);
}

void trace_try(Trace& trace, Rung rung, const Change& change, std::optional<Refusal> refusal,
               const Report& report) {
  if (!trace.follows_mesh()) return;
  TraceEvent& event = trace.event();
  // A boundary edge was split in its place, and has been told.
  if (!refusal && event.removed.empty() && !trace.is_full()) return;
  if (change.what != Change::Vertex::none) event.place = change.place;
  event.routine = static_cast<std::uint8_t>(static_cast<std::size_t>(Routine::count_) +
                                            static_cast<std::size_t>(rung));
  trace.count(report.searches_recover.searches + report.searches_refine.searches,
              report.searches_recover.computations + report.searches_refine.computations);
  constexpr auto kRefused = static_cast<std::size_t>(TraceOutcome::refused);
  trace.record(static_cast<std::uint8_t>(refusal ? kRefused + 1 + static_cast<std::size_t>(*refusal)
                                                 : std::size_t{0}));
}

}  // namespace deliso
