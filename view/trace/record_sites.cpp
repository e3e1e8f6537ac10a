// SPDX-License-Identifier: MIT
// Records Stage 1 of the exact program.
#include "surface/parameters.h"
#include "view/trace/recorder.h"

namespace deliso {
namespace {

Routine routine_of(Reason reason) {
  switch (reason) {
    case Reason::protrusion:
      return Routine::find_protrusions;
    case Reason::crossing:
      return Routine::resolve_crossings;
    default:
      return Routine::correct_reversed;
  }
}

}  // namespace

void TraceRecorder::run_begins(const Parameters& parameters, const Report& report) {
  Recording::run_begins(report.searches_coarsen, report.searches_refine, parameters.r_min);
}

void TraceRecorder::labels_ready(const Labels& labels, const Box3& domain) {
  labels_begin(labels, domain);
}

void TraceRecorder::site_asked(Reason reason, SiteId asker, VertexId v) {
  asks_site(routine_of(reason), trace_code(reason), asker, v);
}

void TraceRecorder::site_asked(paper::Reason reason, SiteId asker, VertexId v) {
  asks_site(Routine::certify, trace_code(reason), asker, v);
}

void TraceRecorder::insertion_begins(const Vec3& p, const ConflictZone& zone) {
  if (!trace_.is_full()) tell_zone(p, zone);
}

void TraceRecorder::site_added(SiteId site) {
  if (!trace_.is_full()) show_labels(site);
  record(TraceOutcome::done);
}

}  // namespace deliso
