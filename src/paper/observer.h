// SPDX-License-Identifier: MIT
// What a run tells while it goes on: for progress bars and traces. Without influence on the mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/cancel.h"
#include "delaunay/triangulation.h"
#include "mesh/tri_mesh.h"

namespace deliso::paper {

class RestrictedDelaunay;
struct SurfaceMesh;
struct Report;

enum class Routine : std::uint8_t { multi_intersect, extract_manifold, approximate_geom };
// Why a point is not inserted; `split` has another in its place.
enum class Refusal : std::uint8_t { vertex_there, split, at_curve, not_a_disk };

class Observer {
 public:
  virtual ~Observer() = default;

  virtual void stage_begins(const char* /*stage*/) {}
  virtual void steps_done(std::size_t /*done*/, std::size_t /*queued*/) {}

  // Stage 1. Del S_0|Sigma is known; both follow the run.
  virtual void sample_ready(const RestrictedDelaunay&, const Report&) {}
  // A hit of the facet shall be inserted: it has `value` hits, or a vertex q is no disk, or `value`
  // is how far a criterion is passed.
  virtual void asks(Routine, Facet, SiteId /*q*/, double /*value*/, const Vec3& /*x*/) {}
  virtual void insertion_begins(const Vec3&, const ConflictZone&) {}
  virtual void site_added(SiteId) {}
  virtual void refused(Refusal) {}
  virtual void recovered() {}

  // Stage 2.
  virtual void mesh_ready(const SurfaceMesh&) {}
  virtual void asks(FaceId, double /*value*/) {}
  // E is to be replaced by the cone over its boundary.
  virtual void cone_begins(const Vec3&, std::span<const FaceId> /*E*/) {}
  virtual void cone_added(VertexId, std::span<const FaceId> /*D*/) {}
  virtual void mesh_finished() {}
};

// Counts steps. At every 1024th it reports, and polls for cancellation.
class Steps {
 public:
  explicit Steps(Observer* observer) : observer_(observer) {}

  void step(std::size_t queued) {
    if (++done_ % 1024 != 0) return;
    throw_if_canceled();
    if (observer_) observer_->steps_done(done_, queued);
  }

 private:
  Observer* observer_;
  std::size_t done_ = 0;
};

}  // namespace deliso::paper
