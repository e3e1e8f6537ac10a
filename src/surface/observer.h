// SPDX-License-Identifier: MIT
// What the stages tell of themselves while they run: events that the algorithm has anyway. Traces,
// profiles and progress bars implement this from outside; nothing is decided by it. A run that
// nobody observes pays the test of a pointer for each event.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "base/box3.h"
#include "base/ids.h"
#include "base/vec3.h"
#include "mesh/tri_mesh.h"
#include "surface/criteria.h"
#include "surface/report.h"

namespace deliso {

struct Change;
struct ConflictZone;
struct SurfaceMesh;
class Labels;
class RestrictedDelaunay;
using RecordId = std::uint32_t;

// Why a point is inserted or an operation tried; then the criteria, by reason_of().
enum class Reason : std::uint8_t {
  beginning,     // of a stage
  several_hits,  // Stage 1, the paper's way
  star_empty,
  star_half_disk,
  star_singular,
  star_off_chain,
  encroached,
  region,  // Stage 1, certified
  interface,
  triple,
  boundary,
  protrusion,
  crossing,
  reversed,
  not_delaunay,  // Stage 2
  no_surface_point,
  off_curve,
  far_point,
  count_
};
constexpr Reason reason_of(Criterion c) {
  return static_cast<Reason>(static_cast<unsigned>(Reason::count_) + static_cast<unsigned>(c));
}

// What an insertion of the paper's came to.
enum class Attempt : std::uint8_t { inserted, split, forgotten, refused };

// Where time goes; an insertion is all from its conflict zone on.
enum class Activity : std::uint8_t { insertion, search, triangulation, disk_test, count_ };

class Observer {
 public:
  virtual ~Observer() = default;

  virtual void stage_begins(const char* /*stage*/) {}
  // Of the stage, `done` steps are done and `queued` more are known.
  virtual void steps_done(std::size_t /*done*/, std::size_t /*queued*/) {}

  // Whether the events below are wanted. Stage 2 then refines the mesh in one region, in the order
  // of Figure 9.
  virtual bool follows_insertions() const { return false; }

  // Stage 1. The first sites have their vertices of T.
  virtual void labels_ready(const Labels&, const Box3& /*domain*/) {}
  // The vertex `v` of T is to be a site. `asker`: the site that says so; kNoId: a look at all of K.
  virtual void site_asked(Reason, SiteId /*asker*/, VertexId /*v*/) {}
  // It is one.
  virtual void site_added(SiteId /*site*/) {}
  // A point is inserted, and these cells go for it.
  virtual void insertion_begins(const Vec3&, const ConflictZone&) {}

  // By the paper's way. Facets of Del S that meet Sigma have records.
  virtual void restricted_ready(const RestrictedDelaunay&) {}
  // An insertion is asked for by an edge of the boundary, by a vertex q whose facets are no disk,
  // with the facet that has their furthest surface point (kNoId: none), or by a facet; `value`: how
  // far it violates what the reason names.
  virtual void edge_asked(SiteId /*from*/, SiteId /*to*/) {}
  virtual void star_asked(SiteId /*q*/, bool /*on_boundary*/, RecordId) {}
  virtual void record_asked(RecordId, Reason, double /*value*/) {}
  // The facet is about to be none of Del S|Sigma any more, if it was one.
  virtual void record_gone(RecordId) {}
  // The point came; for what it was asked, or splitting an edge of the boundary in its place.
  virtual void point_inserted(SiteId /*v*/) {}
  virtual void edge_split(SiteId /*from*/, SiteId /*to*/) {}
  // What was asked for is done, in one insertion or several, or not.
  virtual void attempt_ended(Attempt, const Vec3&) {}
  // With the searches of the stage so far. An insertion that is given up does not end.
  virtual void work_begins(Activity, const SearchCounters&) {}
  virtual void work_ends(Activity, const SearchCounters&) {}

  virtual void recovery_finished() {}

  // Stage 2: the mesh takes the place of the triangulation.
  virtual void mesh_handed_over(const SurfaceMesh&) {}
  // A facet asks for an operation; `value`: how far it violates what the reason names.
  virtual void facet_asked(const SurfaceMesh&, FaceId, Reason, double /*value*/) {}
  // The operation was done, or refused, and the mesh is as it was.
  virtual void operation_tried(Rung, const Change&, std::optional<Refusal>) {}
  virtual void mesh_finished() {}
};

inline void begin_stage(Observer* observer, const char* stage) {
  if (observer) observer->stage_begins(stage);
}

// The one who wants to know of every insertion, if there is one.
inline Observer* follower(Observer* observer) {
  return observer && observer->follows_insertions() ? observer : nullptr;
}

// Tells of the steps of a stage now and then.
class Steps {
 public:
  explicit Steps(Observer* observer) : observer_(observer) {}

  void step(std::size_t queued) {
    constexpr std::size_t kEvery = 1024;
    if (++done_ % kEvery == 0 && observer_) observer_->steps_done(done_, queued);
  }

 private:
  Observer* observer_;
  std::size_t done_ = 0;
};

// Work that is done while this lives.
class Working {
 public:
  Working(Observer* follower, Activity activity, const SearchCounters& searches)
      : follower_(follower), activity_(activity), searches_(searches) {
    if (follower_) follower_->work_begins(activity_, searches_);
  }
  Working(const Working&) = delete;
  Working& operator=(const Working&) = delete;
  ~Working() {
    if (follower_) follower_->work_ends(activity_, searches_);
  }

 private:
  Observer* follower_;
  Activity activity_;
  const SearchCounters& searches_;
};

}  // namespace deliso
