// SPDX-License-Identifier: MIT
// Records a run of the exact program: the exact contour T, the mesh that it is coarsened to, and
// who asked for an operation, why, and what came of it.
#pragma once

#include <optional>
#include <span>
#include <utility>
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

  // Stage 1: T, how it is coarsened, and the mesh that this leaves. A removal is an event, or
  // several of a large T; the moves of a sweep are one, and its flips.
  void contour_ready(const SurfaceMesh& t) override;
  void coarsening_begins(const SurfaceMesh& t) override;
  void coarsened(Operation operation, VertexId v, std::span<const FaceId> facets) override;
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

  // T of more vertices has several removals in an event, so that pages stay small.
  static constexpr std::size_t kMostRemovals = 8000;

  // Ends the event of coarsening that has begun, if one has.
  void end_coarsening_event();
  // A facet of the mesh that is coarsened; kNoId: none.
  Triangle number(Triangle t) const;
  using Recording::number;

  Observer* also_;
  const SurfaceMesh* mesh_ = nullptr;  // the one that changes
  // Of coarsening, per facet: its corners, and what they were in the trace after the last event.
  IdArray<FaceId, Triangle> now_, told_;
  // Of the event that has begun; count_: none has.
  Operation operation_ = Operation::count_;
  std::size_t removals_ = 0, removals_per_event_ = 1;  // so far, and when it ends
  std::vector<FaceId> touched_;
  std::vector<std::pair<VertexId, Vec3>> moved_;
};

}  // namespace deliso
