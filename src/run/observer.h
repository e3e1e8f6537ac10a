// SPDX-License-Identifier: MIT
// Events that the stages report while they run. Traces and progress bars implement Observer; it has
// no influence on the result. Without an observer an event costs the test of a pointer.
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
#include "run/criteria.h"
#include "run/report.h"

namespace deliso {

struct Parameters;
struct Replacement;
class Question;
struct SurfaceMesh;

// Why an operation is tried. The criteria follow, by reason_of().
enum class Reason : std::uint8_t {
  beginning,  // of a stage
  not_delaunay,
  no_surface_point,
  off_its_curve,
  far_point,
  unneeded,  // of a vertex; those above are of facets
  too_near,  // of a facet folded onto another, or with a short edge; of a vertex to be moved off
  count_
};
constexpr Reason reason_of(Criterion c) {
  return static_cast<Reason>(static_cast<unsigned>(Reason::count_) + static_cast<unsigned>(c));
}

// A volume in several blocks has the stage "blocks", whose steps are weights of blocks, in place of
// the stages of one block. Then come "weld", and "seams" once for each round.
class Observer : public StageObserver {
 public:
  // True if the events below are wanted. The volume is then one block.
  virtual bool follows_insertions() const { return false; }

  // The stages begin. They fill this report, the block's, whose counts follow along, until
  // mesh_finished().
  virtual void run_begins(const Parameters&, const Report&) {}

  // Stage 1: T as a mesh, which has no duals yet.
  virtual void contour_ready(const SurfaceMesh&) {}
  // It is coarsened: from now on, or again from T on where it came to cross itself.
  virtual void coarsening_begins(const SurfaceMesh&) {}
  // A vertex was removed or moved, or an edge flipped, which has no vertex. These facets changed.
  virtual void coarsened(Operation, VertexId, std::span<const FaceId>) {}
  // Stage 2: T is coarsened.
  virtual void mesh_handed_over(const SurfaceMesh&) {}
  // The operation was done, or it was refused and the mesh is unchanged. The question says why it
  // was tried.
  virtual void operation_tried(const Question&, Operation, const Replacement&,
                               std::optional<Refusal>) {}
  virtual void mesh_finished() {}
};

// Returns the observer if it follows insertions, else null.
inline Observer* follower(Observer* observer) {
  return observer && observer->follows_insertions() ? observer : nullptr;
}

}  // namespace deliso
