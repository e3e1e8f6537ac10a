// SPDX-License-Identifier: MIT
// What a run tells while it goes on: for progress bars and traces. Without influence on the mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/step_counter.h"
#include "delaunay/triangulation.h"
#include "mesh/tri_mesh.h"

namespace deliso {
class Labels;
}

namespace deliso::paper {

class RestrictedDelaunay;
struct SurfaceMesh;
struct Report;

// Why a point shall be inserted: what MultiIntersect and ExtractManifold look for, the latter away
// from the boundary curves and on them, and the criteria of ApproximateGeom and RefineGeom; a facet
// cycle. Then the conditions C1 to C4 of the certified Stage 1, and that a facet has an area.
enum class Reason : std::uint8_t {
  several_hits,
  not_a_disk,
  not_a_half_disk,
  h_over_r,
  r_over_l,
  r_over_pole,  // height
  facet_cycle,
  region,
  interface,
  triple,
  boundary,
  no_area,
};
// Why a point is not inserted; `split` has another in its place.
enum class Refusal : std::uint8_t { vertex_there, split, at_curve, not_a_disk };

class Observer : public StageObserver {
 public:
  // Stage 1. Del S_0|Sigma is known; both follow the run.
  virtual void sample_ready(const RestrictedDelaunay&, const Report&) {}
  // A hit x of the facet shall be inserted: it has `value` hits, or D_q of a vertex q has `value`
  // facets, or it is `value` times over a criterion's limit. For an empty D_q and a facet cycle x
  // is no hit, and the facet any at q. The insertion or a refusal follows.
  virtual void asks(Reason, Facet, SiteId /*q*/, double /*value*/, const Vec3& /*x*/) {}
  virtual void insertion_begins(const Vec3&, const ConflictZone&) {}
  virtual void site_added(SiteId) {}
  virtual void refused(Refusal) {}
  virtual void recovered() {}
  // The certified Stage 1 (recover/certified.h), in place of sample_ready() and asks(). The
  // vertex `v` of T shall be a site, for the sake of the site `q`.
  virtual void labels_ready(const Labels&, const Box3& /*domain*/, const Report&) {}
  virtual void asks_site(Reason, SiteId /*q*/, ContourId /*v*/) {}

  // Stage 2.
  virtual void mesh_ready(const SurfaceMesh&) {}
  virtual void asks(Reason, FaceId, double /*value*/) {}
  // The facet's x encroaches upon E. The cone D over E's boundary takes its place, with E's numbers
  // first; or a refusal follows.
  virtual void encroaches(const Vec3& /*x*/, std::span<const FaceId> /*E*/) {}
  virtual void cone_added(VertexId, std::span<const FaceId> /*D*/) {}
};

}  // namespace deliso::paper
