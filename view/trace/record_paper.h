// SPDX-License-Identifier: MIT
// Records a run of the published program, with either Stage 1: which test asked for an insertion,
// the Voronoi edge and the conflict zone, and the facets of Del S|Sigma, in Stage 2 of T_S, that
// were removed and added.
#pragma once

#include <span>

#include "paper/observer.h"
#include "paper/refine.h"
#include "view/trace/recording.h"

namespace deliso {

class PaperRecorder : public paper::Observer, private Recording {
 public:
  // Keeps references. `also`: is told of the stages too; may be null.
  explicit PaperRecorder(Trace& trace, paper::Observer* also = nullptr)
      : Recording(trace), also_(also) {}

  void stage_begins(const char* stage) override {
    if (also_) also_->stage_begins(stage);
  }
  void steps_done(std::size_t done, std::size_t queued) override {
    if (also_) also_->steps_done(done, queued);
  }

  // Stage 1.
  void sample_ready(const paper::RestrictedDelaunay& del, const paper::Report& report) override;
  void asks(paper::Reason reason, Facet sigma, SiteId q, double value, const Vec3& x) override;
  void labels_ready(const Labels& labels, const Box3& domain, const paper::Report& report) override;
  void asks_site(paper::Reason reason, SiteId q, ContourId v) override;
  void insertion_begins(const Vec3& p, const ConflictZone& zone) override;
  void site_added(SiteId site) override;
  void recovered() override { tell_cells(); }

  // Stage 2.
  void mesh_ready(const paper::SurfaceMesh& t) override;
  void asks(paper::Reason reason, FaceId sigma, double value) override;
  void encroaches(const Vec3& x, std::span<const FaceId> e) override;
  void cone_added(VertexId v, std::span<const FaceId> d) override;

  // Of both.
  void refused(paper::Refusal refusal) override;

 private:
  // A facet of Del S|Sigma, turned as BuildTriMesh does, and one of T_S.
  Triangle number(Facet sigma) const;
  Triangle number(FaceId f) const;
  using Recording::number;

  paper::Observer* also_;
  const paper::RestrictedDelaunay* del_ = nullptr;  // null: of the certified Stage 1
  const paper::SurfaceMesh* mesh_ = nullptr;
  TraceOutcome outcome_ = TraceOutcome::done;  // of the insertion asked for
};

}  // namespace deliso
