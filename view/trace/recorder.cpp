// SPDX-License-Identifier: MIT
#include "view/trace/recorder.h"

#include <algorithm>

#include "stage1/first_sample.h"
#include "surface/parameters.h"

namespace deliso {

void TraceRecorder::number_vertices() {
  const Triangulation& t = triangulation();
  if (numbers_.empty()) numbers_.emplace_back(kNoId);  // the infinite vertex
  for (auto v = SiteId(numbers_.size()); v < t.vertex_capacity(); ++v) {
    numbers_.push_back(is_auxiliary(t.point(v), box_) ? VertexId(kNoId)
                                                      : trace_.add_vertex(t.point(v)));
  }
}

bool TraceRecorder::is_told(CellId c) const {
  const auto& v = triangulation().vertices(c);
  return std::none_of(v.begin(), v.end(), [&](SiteId q) { return number(q) == kNoId; });
}

TraceEvent& TraceRecorder::asks(Routine routine, Reason reason, double value) {
  return trace_.asks(trace_code(routine), trace_code(reason), value);
}

void TraceRecorder::insertion_begins(const Vec3& p, const ConflictZone& zone) {
  if (trace_.is_full()) return;
  TraceEvent& event = trace_.event();
  event.place = p;
  for (const CellId c : zone.cells) {
    if (!is_told(c)) continue;
    const auto& v = triangulation().vertices(c);
    event.zone.push_back({number(v[0]), number(v[1]), number(v[2]), number(v[3])});
  }
}

void TraceRecorder::site_added(SiteId site) {
  show_labels(site);
  record(TraceOutcome::done);
}

void TraceRecorder::run_begins(const Parameters& parameters, const Report& report) {
  report_ = &report;
  r_min_ = parameters.r_min;
}

void TraceRecorder::count_searches() {
  SearchCounters searches = report_->searches_recover;
  searches += report_->searches_refine;
  trace_.count(searches.searches, searches.computations);
}

void TraceRecorder::record(std::uint8_t outcome) {
  count_searches();
  trace_.record(outcome);
}

void TraceRecorder::recovery_finished() {
  if (trace_.is_full()) return;
  const Triangulation& t = triangulation();
  for (CellId c = 0; c < t.cell_capacity(); ++c) {
    if (!t.is_live(c) || !is_told(c)) continue;
    for (const SiteId v : t.vertices(c)) trace_.arrays().tets.push_back(number(v));
  }
}

}  // namespace deliso
