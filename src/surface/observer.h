// SPDX-License-Identifier: MIT
// Events that the stages report while they run. Traces and progress bars implement
// Observer; it has no influence on the result. Without an observer an event costs the test of a
// pointer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "base/box3.h"
#include "base/ids.h"
#include "base/step_counter.h"
#include "base/vec3.h"
#include "mesh/tri_mesh.h"
#include "surface/criteria.h"
#include "surface/report.h"

namespace deliso {

namespace paper {
enum class Reason : std::uint8_t;
}

struct Parameters;
struct Proposal;
class Question;
struct ConflictZone;
struct SurfaceMesh;
class Labels;

// Why a point is inserted or an operation tried. The criteria follow, by reason_of().
enum class Reason : std::uint8_t {
  beginning,   // of a stage
  protrusion,  // Stage 1; before them the conditions of the certificate, paper::Reason
  crossing,
  reversed,
  not_delaunay,  // Stage 2
  no_surface_point,
  off_curve,
  far_point,
  unneeded,  // of a vertex; those above are of facets
  too_near,  // of a facet folded onto another, or with a short edge; of a vertex to be moved off
  count_
};
constexpr Reason reason_of(Criterion c) {
  return static_cast<Reason>(static_cast<unsigned>(Reason::count_) + static_cast<unsigned>(c));
}

class Observer {
 public:
  virtual ~Observer() = default;

  virtual void stage_begins(const char* /*stage*/) {}
  // The stage has done `done` steps, and `queued` more are known. A volume in several blocks has
  // one stage, "blocks", whose steps are weights of blocks.
  virtual void steps_done(std::size_t /*done*/, std::size_t /*queued*/) {}

  // True if the events below are wanted. The volume is then one block.
  virtual bool follows_insertions() const { return false; }

  // The stages begin. They fill this report, whose counts follow along, until mesh_finished(). Of a
  // volume in blocks it is the block's.
  virtual void run_begins(const Parameters&, const Report&) {}

  // Stage 1. The regions of the first sites are known.
  virtual void labels_ready(const Labels&, const Box3& /*domain*/) {}
  // The vertex `v` of T shall be a site. `asker`: the site whose test demands it; kNoId: a test of
  // all of K.
  virtual void site_asked(Reason, SiteId /*asker*/, VertexId /*v*/) {}
  virtual void site_asked(paper::Reason, SiteId /*asker*/, VertexId /*v*/) {}
  // A point is inserted, and the cells of the zone are removed; then the point is a site, that
  // vertex.
  virtual void insertion_begins(const Vec3&, const ConflictZone&) {}
  virtual void site_added(SiteId /*site*/) {}

  virtual void recovery_finished() {}

  // Stage 2: the mesh replaces the triangulation.
  virtual void mesh_handed_over(const SurfaceMesh&) {}
  // The operation was done, or it was refused and the mesh is unchanged. The question says why it
  // was tried.
  virtual void operation_tried(const Question&, Operation, const Proposal&,
                               std::optional<Refusal>) {}
  virtual void mesh_finished() {}
};

inline void begin_stage(Observer* observer, const char* stage) {
  if (observer) observer->stage_begins(stage);
}

// Returns the observer if it follows insertions, else null.
inline Observer* follower(Observer* observer) {
  return observer && observer->follows_insertions() ? observer : nullptr;
}

using Steps = StepCounter<Observer>;

}  // namespace deliso
