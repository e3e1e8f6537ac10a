// SPDX-License-Identifier: MIT
// Records a run of the exact program: who asked for an insertion or an operation, why, and what
// came of it.
#pragma once

#include <optional>
#include <vector>

#include "surface/observer.h"
#include "surface/report.h"
#include "surface/surface_mesh.h"
#include "view/trace/recording.h"

namespace deliso {

class TraceRecorder : public Observer, private Recording {
 public:
  // Keeps references. `also`: is told of the stages too; may be null.
  explicit TraceRecorder(Trace& trace, Observer* also = nullptr) : Recording(trace), also_(also) {}

  void stage_begins(const char* stage) override {
    if (also_) also_->stage_begins(stage);
  }
  void steps_done(std::size_t done, std::size_t queued) override {
    if (also_) also_->steps_done(done, queued);
  }
  bool follows_insertions() const override { return true; }
  void run_begins(const Parameters& parameters, const Report& report) override;

  // Stage 1, record_sites.cpp.
  void labels_ready(const Labels& labels, const Box3& domain) override;
  void site_asked(Reason reason, SiteId asker, VertexId v) override;
  void site_asked(paper::Reason reason, SiteId asker, VertexId v) override;
  void insertion_begins(const Vec3& p, const ConflictZone& zone) override;
  void site_added(SiteId site) override;
  void recovery_finished() override { tell_cells(); }

  // Stage 2, record_mesh.cpp: every operation with its cavity, the new facets, and the test that
  // refused it. Nothing is recorded before the mesh is handed over or after it is finished.
  void mesh_handed_over(const SurfaceMesh& s) override;
  void operation_tried(const Question& question, Operation operation, const Proposal& proposal,
                       std::optional<Refusal> refusal) override;
  void mesh_finished() override { trace_.end_mesh(); }

 private:
  // Facets of the mesh; `new_vertex`, of a try, has no number.
  void number_mesh(const std::vector<Triangle>& facets, VertexId new_vertex,
                   std::vector<Triangle>& out) const;
  // Begins the event of an operation of Stage 2.
  void tell_question(const Question& question, Operation operation);
  // What refused it, as a line: the dual line that misses Sigma, as far as a surface point may be,
  // or the edge that would be too sharp.
  std::optional<Segment> culprit(const Proposal& proposal, Refusal refusal) const;

  Observer* also_;
  const SurfaceMesh* mesh_ = nullptr;  // of Stage 2
};

}  // namespace deliso
