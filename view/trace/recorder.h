// SPDX-License-Identifier: MIT
// Records a run of the exact program: the exact contour T, the mesh that it is coarsened to, and
// who asked for an operation, why, and what came of it.
#pragma once

#include <optional>
#include <vector>

#include "run/observer.h"
#include "run/report.h"
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

  // Stage 1 is two events, T and what it is coarsened to.
  void contour_ready(const SurfaceMesh& t) override;
  // Stage 2: every operation with its cavity, the new facets, and the test that refused it. Nothing
  // is recorded after the mesh is finished.
  void mesh_handed_over(const SurfaceMesh& s) override;
  void operation_tried(const Question& question, Operation operation,
                       const Replacement& replacement, std::optional<Refusal> refusal) override;
  void mesh_finished() override { target().end_mesh(); }

 private:
  // Facets of the mesh; `new_vertex`, of a try, has no number.
  void number_mesh(const std::vector<Triangle>& facets, VertexId new_vertex,
                   std::vector<Triangle>& out) const;
  // Begins the event of an operation of Stage 2.
  void tell_question(const Question& question, Operation operation);
  // What refused it, as a line: the dual line that misses Sigma, as far as a surface point may be,
  // or the edge that would be too sharp.
  std::optional<Segment> culprit(const Replacement& replacement, Refusal refusal) const;

  Observer* also_;
  const SurfaceMesh* mesh_ = nullptr;  // of Stage 2
};

}  // namespace deliso
