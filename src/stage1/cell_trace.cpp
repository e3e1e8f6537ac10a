// SPDX-License-Identifier: MIT
#include "stage1/cell_trace.h"

#include <algorithm>

#include "stage1/first_sample.h"

namespace deliso {

void CellTrace::number_vertices(const Triangulation& t) {
  if (numbers_.empty()) numbers_.push_back(kNoId);  // the infinite vertex
  for (auto v = static_cast<VertexId>(numbers_.size()); v < t.vertex_capacity(); ++v) {
    numbers_.push_back(is_auxiliary(t.point(v), box_) ? kNoId : trace_.add_vertex(t.point(v)));
  }
}

bool CellTrace::is_told(const Triangulation& t, CellId c) const {
  const auto& v = t.vertices(c);
  return std::none_of(v.begin(), v.end(), [&](VertexId q) { return number(q) == kNoId; });
}

void CellTrace::add_zone(const Triangulation& t, const ConflictZone& zone, const Vec3& p) {
  TraceEvent& event = trace_.event();
  event.place = p;
  for (const CellId c : zone.cells) {
    if (!is_told(t, c)) continue;
    const auto& v = t.vertices(c);
    event.zone.push_back({number(v[0]), number(v[1]), number(v[2]), number(v[3])});
  }
}

void CellTrace::record(TraceOutcome outcome) {
  trace_.count(report_.searches_recover.searches, report_.searches_recover.computations);
  trace_.record(outcome);
}

void CellTrace::keep_cells(const Triangulation& t) {
  if (trace_.is_full()) return;
  for (CellId c = 0; c < t.cell_capacity(); ++c) {
    if (!t.is_live(c) || !is_told(t, c)) continue;
    for (const VertexId v : t.vertices(c)) trace_.arrays().tets.push_back(number(v));
  }
}

}  // namespace deliso
