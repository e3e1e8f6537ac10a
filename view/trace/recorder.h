// SPDX-License-Identifier: MIT
// Fills a trace from outside, by what the stages tell: vertices, cells and facets by the trace's
// own numbers, and who asked for an insertion and why.
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "recover/labels.h"
#include "surface/observer.h"
#include "surface/report.h"
#include "surface/surface_mesh.h"
#include "view/trace/trace.h"

namespace deliso {

class TraceRecorder : public Observer {
 public:
  // Keeps references. `also`: is told of the stages too; may be null.
  explicit TraceRecorder(Trace& trace, Observer* also = nullptr) : trace_(trace), also_(also) {}

  void stage_begins(const char* stage) override {
    if (also_) also_->stage_begins(stage);
  }
  void steps_done(std::size_t done, std::size_t queued) override {
    if (also_) also_->steps_done(done, queued);
  }
  bool follows_insertions() const override { return true; }
  void run_begins(const Parameters& parameters, const Report& report) override;

  // Stage 1, record_labels.cpp.
  void insertion_begins(const Vec3& p, const ConflictZone& zone) override;
  void site_added(SiteId site) override;
  void recovery_finished() override;

  void labels_ready(const Labels& labels, const Box3& domain) override;
  void site_asked(Reason reason, SiteId asker, VertexId v) override;

  // Stage 2, record_mesh.cpp: every operation with its cavity, the new facets, and the test that
  // refused it. Nothing is recorded before the mesh is handed over or after it is finished.
  void mesh_handed_over(const SurfaceMesh& s) override;
  void operation_tried(const Question& question, Operation operation, const Proposal& proposal,
                       std::optional<Refusal> refusal) override;
  void mesh_finished() override;

 private:
  // T of more triangles is not shown.
  static constexpr std::size_t kMostTriangles = 400'000;

  const Triangulation& triangulation() const { return labels_->triangulation(); }
  // All vertices that are new; auxiliary ones have no number.
  void number_vertices();
  // Returns kNoId for a vertex that has no number: an auxiliary one, or one that came after the
  // trace was full. Every look-up goes through here, so that no caller need ask whether it is.
  template <class Tag>
  VertexId number(Id<Tag> v) const {
    return v < numbers_.size() ? numbers_[v] : VertexId(kNoId);
  }
  template <class Tag>
  Triangle number(const std::array<Id<Tag>, 3>& v) const {
    return {number(v[0]), number(v[1]), number(v[2])};
  }
  bool is_told(CellId c) const;
  // Facets of the mesh; `new_vertex`, of a try, has no number.
  void number_mesh(const std::vector<Triangle>& facets, VertexId new_vertex,
                   std::vector<Triangle>& out) const;
  TraceEvent& asks(Routine routine, Reason reason, double value);
  // Begins the event of an operation of Stage 2.
  void tell_question(const Question& question, Operation operation);
  // What refused it, as a line: the dual line that misses Sigma, as far as a surface point may be,
  // or the edge that would be too sharp.
  std::optional<Segment> culprit(const Proposal& proposal, Refusal refusal) const;
  void count_searches();
  // Ends the event.
  void record(std::uint8_t outcome);
  void record(TraceOutcome outcome) { record(trace_code(outcome)); }
  // The labels that a new site changed.
  void show_labels(SiteId site);
  // Facets of the mesh went, others came: the trace gets the worst distance of those there.
  void update_worst(const std::vector<FaceId>& gone, const std::vector<FaceId>& come);

  Trace& trace_;
  Observer* also_;
  const Report* report_ = nullptr;  // that the stages fill; null before and after
  double r_min_ = 0;
  Box3 box_;                       // the domain
  std::vector<VertexId> numbers_;  // the trace's, per site, then per vertex of the mesh

  const Labels* labels_ = nullptr;
  bool shows_contour_ = false;
  std::vector<SiteId> label_;  // of every vertex of T, before the site that is being added

  const SurfaceMesh* mesh_ = nullptr;  // of Stage 2
  IdArray<FaceId, double> distance_;   // of each facet, as Report::largest_h; 0 up to r_min
  std::multiset<double> distances_;    // of the live ones
};

}  // namespace deliso
