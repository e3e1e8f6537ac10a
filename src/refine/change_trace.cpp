// SPDX-License-Identifier: MIT
#include "refine/change_trace.h"

#include <cmath>

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

void trace_facet(Trace& trace, const SurfaceMesh& s, FaceId f, std::uint8_t reason, double value) {
  if (!is_told(trace)) return;
  TraceEvent& event = trace.asks(trace_code(Routine::count_), reason, value);
  event.caller = number(trace, s.mesh.faces[f].v);
  const Dual& dual = s.duals[f];
  if (dual.on_surface) event.ball = {dual.center, std::sqrt(dual.radius2)};
}

void trace_criteria(Trace& trace, const SurfaceMesh& s, FaceId f, const FacetShape& shape,
                    const Criteria& criteria) {
  trace_facet(trace, s, f, trace_code(worst_criterion(shape, criteria)),
              violation(shape, criteria));
}

void trace_not_delaunay(Trace& trace, const SurfaceMesh& s, FaceId f) {
  const Dual& dual = s.duals[f];
  trace_facet(trace, s, f,
              trace_code(dual.on_surface ? Reason::not_delaunay : Reason::no_surface_point),
              std::sqrt(dual.radius2));
}

void trace_off_curve(Trace& trace, const SurfaceMesh& s, FaceId f, int side) {
  const Triangle& v = s.mesh.faces[f].v;
  const Vec3 &a = s.mesh.points[v[(side + 1) % 3]], &b = s.mesh.points[v[(side + 2) % 3]];
  trace_facet(trace, s, f, trace_code(Reason::off_curve), distance(a, b));
}

void trace_disk(Trace& trace, const Change& change) {
  if (!is_told(trace)) return;
  TraceEvent& event = trace.event();
  add(trace, change.was, event.star);
  event.cone.clear();
}

void trace_replacement(Trace& trace, const Change& change, bool is_done) {
  if (!trace.follows_mesh()) return;
  TraceEvent& event = trace.event();
  event.is_changed = is_done;
  if (trace.is_full()) return;
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
  if (!refusal && !event.is_changed) return;
  if (change.what != Change::Vertex::none) event.place = change.place;
  event.routine = trace_code(rung);
  trace.count(report.searches_recover.searches + report.searches_refine.searches,
              report.searches_recover.computations + report.searches_refine.computations);
  trace.record(refusal ? trace_code(*refusal) : trace_code(TraceOutcome::done));
}

}  // namespace deliso
