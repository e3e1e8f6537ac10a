// SPDX-License-Identifier: MIT
// What the stages tell of themselves while they run: events that the algorithm has anyway. Traces,
// profiles and progress bars implement this from outside; nothing is decided by it. A run that
// nobody observes pays the test of a pointer for each event.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "base/ids.h"
#include "base/vec3.h"
#include "mesh/tri_mesh.h"
#include "surface/criteria.h"
#include "surface/report.h"

namespace deliso {

struct Change;
struct ConflictZone;
struct LabelState;
struct SurfaceMesh;
class RestrictedDelaunay;

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

class Observer {
 public:
  virtual ~Observer() = default;

  virtual void stage_begins(const char* /*stage*/) {}
  // Of the stage, `done` steps are done and `queued` more are known; or a share of it, in [0, 1].
  virtual void steps_done(std::size_t /*done*/, std::size_t /*queued*/) {}
  virtual void share_done(double /*share*/) {}

  // Whether the events below are wanted. Stage 2 then refines the mesh in one region, in the order
  // of Figure 9.
  virtual bool follows_insertions() const { return false; }

  // Stage 2: the mesh takes the place of the triangulation.
  virtual void mesh_handed_over(const SurfaceMesh&) {}
  // A facet asks for an operation; `value`: how far it violates what the reason names.
  virtual void facet_asked(const SurfaceMesh&, FaceId, Reason, double /*value*/) {}
  // The operation was done, or refused, and the mesh is as it was.
  virtual void operation_tried(Rung, const Change&, std::optional<Refusal>) {}
  virtual void mesh_finished() {}
};

}  // namespace deliso
