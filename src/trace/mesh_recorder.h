// SPDX-License-Identifier: MIT
// Records Stage 2 in a trace: which facet asks and why, and every operation with the disk E, the
// cone D, and the test that refused it. Nothing is recorded before the mesh is handed over or after
// it is finished, as when it is capped.
#pragma once

#include "surface/observer.h"
#include "trace/trace.h"

namespace deliso {

class MeshRecorder : public Observer {
 public:
  // Keeps references.
  MeshRecorder(Trace& trace, const Report& report) : trace_(trace), report_(report) {}

  bool follows_insertions() const override { return true; }
  void mesh_handed_over(const SurfaceMesh& s) override;
  void facet_asked(const SurfaceMesh& s, FaceId f, Reason reason, double value) override;
  void operation_tried(Rung rung, const Change& change, std::optional<Refusal> refusal) override;
  void mesh_finished() override { trace_.end_mesh(); }

 protected:
  Trace& trace_;
  const Report& report_;

 private:
  bool is_recorded() const { return trace_.follows_mesh() && !trace_.is_full(); }
  // By numbers of the trace; kNoId: the new vertex of a try.
  void number(const std::vector<Triangle>& facets, VertexId new_vertex,
              std::vector<Triangle>& out) const;
};

}  // namespace deliso
