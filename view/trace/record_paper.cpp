// SPDX-License-Identifier: MIT
#include "view/trace/record_paper.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <vector>

#include "paper/recover.h"

namespace deliso {
namespace {

struct Codes {
  Routine routine;  // of Stage 1
  std::uint8_t reason;
};
// In the order of paper::Reason.
constexpr Codes kCodes[] = {{Routine::multi_intersect, trace_code(PaperReason::several_hits)},
                            {Routine::extract_manifold, trace_code(PaperReason::no_disk)},
                            {Routine::extract_manifold, trace_code(PaperReason::no_half_disk)},
                            {Routine::approximate_geom, trace_code(Criterion::h_over_r)},
                            {Routine::approximate_geom, trace_code(Criterion::r_over_l)},
                            {Routine::approximate_geom, trace_code(PaperReason::r_over_pole)},
                            {Routine::extract_manifold, trace_code(PaperReason::facet_cycle)},
                            {Routine::certify, trace_code(PaperReason::region)},
                            {Routine::certify, trace_code(PaperReason::interface)},
                            {Routine::certify, trace_code(PaperReason::triple)},
                            {Routine::certify, trace_code(PaperReason::boundary)},
                            {Routine::certify, trace_code(PaperReason::no_area)}};
constexpr const Codes& codes_of(paper::Reason reason) {
  return kCodes[static_cast<std::size_t>(reason)];
}

// In the order of paper::Refusal.
constexpr TraceOutcome kOutcomes[] = {TraceOutcome::vertex_there, TraceOutcome::split,
                                      TraceOutcome::beside_a_curve, TraceOutcome::no_disk};

// Returns those of a that are not in b; both are ascending.
std::vector<Triangle> difference(const std::vector<Triangle>& a, const std::vector<Triangle>& b) {
  std::vector<Triangle> out;
  std::ranges::set_difference(a, b, std::back_inserter(out));
  return out;
}

}  // namespace

std::uint8_t trace_code(paper::Reason reason) {
  return codes_of(reason).reason;
}

Triangle PaperRecorder::number(Facet sigma) const {
  const SiteTriangle v = facet_vertices(del_->del(), sigma);
  const Hit& x = paper::nearest(del_->hits(sigma), del_->del().point(v[0]));
  return number(paper::turned(v, x));
}

Triangle PaperRecorder::number(FaceId f) const {
  const std::vector<VertexId>& numbers = target().of_mesh();
  const Triangle& v = mesh_->mesh.faces[f].v;
  return {numbers[v[0]], numbers[v[1]], numbers[v[2]]};
}

void PaperRecorder::sample_ready(const paper::RestrictedDelaunay& del,
                                 const paper::Report& report) {
  del_ = &del;
  run_begins(report.searches_recover, report.searches_refine, report.r_min);
  sites_begin(del.del(), del.sigma().volume().box());
  TraceEvent& event =
      target().asks(trace_code(Routine::init_triangulation), trace_code(Reason::beginning),
                    static_cast<double>(del.created().size()));
  for (const Facet f : del.created()) event.added.push_back(number(f));
  record(TraceOutcome::done);
}

void PaperRecorder::asks(paper::Reason reason, Facet sigma, SiteId q, double value, const Vec3& x) {
  outcome_ = TraceOutcome::done;
  if (target().is_full()) return;
  const Triangulation& t = del_->del();
  const SiteTriangle corners = facet_vertices(t, sigma);
  const auto [routine, code] = codes_of(reason);
  TraceEvent& event = target().asks(trace_code(routine), code, value);
  event.caller = number(corners);
  if (q != kNoId) {
    event.caller = {number(q), kNoId, kNoId};
    std::vector<Facet> d_q;
    del_->star(q, d_q);
    for (const Facet f : d_q) event.star.push_back(number(f));
  }
  event.place = x;
  event.ball = {x, distance(x, t.point(q != kNoId ? q : corners[0]))};
  const std::span<const Hit> hits = del_->hits(sigma);
  if (std::ranges::none_of(hits, [&](const Hit& h) { return h.point == x; })) return;
  event.edge = del_->voronoi_edge(sigma);
  for (const Hit& hit : hits) event.hits.push_back(hit.point);
}

void PaperRecorder::labels_ready(const Labels& labels, const Box3& domain,
                                 const paper::Report& report) {
  run_begins(report.searches_recover, report.searches_refine, report.r_min);
  labels_begin(labels, domain);
}

void PaperRecorder::asks_site(paper::Reason reason, SiteId q, ContourId v) {
  outcome_ = TraceOutcome::done;
  const auto [routine, code] = codes_of(reason);
  if (!target().is_full()) Recording::asks_site(routine, code, q, v);
}

void PaperRecorder::insertion_begins(const Vec3& p, const ConflictZone& zone) {
  if (target().is_full()) return;
  tell_zone(p, zone);
  if (!del_) return;
  std::vector<Triangle>& gone = target().event().removed;
  for (const CellId c : zone.cells) {
    for (int i = 0; i < 4; ++i) {
      if (!del_->hits({c, i}).empty()) gone.push_back(number(Facet{c, i}));
    }
  }
  // Facets inside the zone are those of two of its cells.
  std::ranges::sort(gone);
  gone.erase(std::unique(gone.begin(), gone.end()), gone.end());
}

void PaperRecorder::site_added(SiteId site) {
  if (!target().is_full() && !del_) {
    show_labels(site);
  } else if (!target().is_full()) {
    number_sites();
    TraceEvent& event = target().event();
    event.vertex = number(site);
    std::vector<Triangle> there;
    for (const Facet f : del_->created()) there.push_back(number(f));
    std::ranges::sort(there);
    // Facets of the zone's boundary may have stayed.
    event.added = difference(there, event.removed);
    event.removed = difference(event.removed, there);
  }
  record(outcome_);
}

void PaperRecorder::mesh_ready(const paper::SurfaceMesh& t) {
  mesh_ = &t;
  mesh_begins(t.mesh, Routine::build_tri_mesh, [&t](FaceId f) {
    const paper::SurfaceMesh::Dual& dual = t.duals[f];
    return dual.on_sigma ? std::optional(dual.x) : std::nullopt;
  });
}

void PaperRecorder::asks(paper::Reason reason, FaceId sigma, double value) {
  if (target().is_full()) return;
  TraceEvent& event =
      target().asks(trace_code(Operation::surface_point), codes_of(reason).reason, value);
  event.caller = number(sigma);
  const Vec3& x = mesh_->duals[sigma].x;
  event.ball = {x, distance(x, mesh_->mesh.points[mesh_->mesh.faces[sigma].v[0]])};
}

void PaperRecorder::encroaches(const Vec3& x, std::span<const FaceId> e) {
  if (target().is_full()) return;
  target().event().place = x;
  for (const FaceId f : e) target().event().star.push_back(number(f));
}

void PaperRecorder::cone_added(VertexId, std::span<const FaceId> d) {
  if (!target().is_full()) {
    TraceEvent& event = target().event();
    event.removed.swap(event.star);
    event.vertex = target().add_vertex(event.place);
    target().of_mesh().push_back(event.vertex);
    for (const FaceId f : d) event.added.push_back(number(f));
    update_worst(d.first(event.removed.size()), d);
  }
  record(TraceOutcome::done);
}

void PaperRecorder::refused(paper::Refusal refusal) {
  outcome_ = kOutcomes[static_cast<std::size_t>(refusal)];
  if (outcome_ != TraceOutcome::split) record(outcome_);  // a split's insertion follows
}

}  // namespace deliso
