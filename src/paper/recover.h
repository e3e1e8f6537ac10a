// SPDX-License-Identifier: MIT
// Stage 1, Recover(Del S) of paper Figure 5. It adds points until Del S|Sigma is a manifold whose
// facets follow the surface roughly.
//
// It differs from the paper in three ways. Worklists replace sweeps. An insertion that encroaches
// upon an edge of the boundary chain splits that edge instead. Faults that cannot be resolved are
// counted and left.
//
// Its tests miss some pieces of Sigma: a component within its own Voronoi cells, one smaller than
// r_min, a wedge at the box too thin for a Voronoi edge. They are lost, and the report shows it.
#pragma once

#include <deque>
#include <vector>

#include "paper/restricted.h"
#include "stage1/first_sample.h"
#include "surface/observer.h"

namespace deliso {

// The state of Stage 1, and its insertion.
class Recovery {
 public:
  // Keeps references to all but `first`.
  Recovery(const Isosurface& surface, const BoundaryCurves& curves, FirstSample first,
           const Parameters& parameters, Report& report);
  const RestrictedDelaunay& restricted() const { return restricted_; }
  const SiteChain& chain() const { return chain_; }

  // Runs all of Figure 5.
  void recover();
  // Reports to the observer that the stage begins.
  void begin(const char* stage) {
    begin_stage(parameters_.observer, stage);
    steps_ = Steps(parameters_.observer);
  }

  // Splits edges of the boundary chain until none has a vertex in its diametral ball.
  void protect_boundary();
  // Inserts points until no Voronoi edge meets Sigma more than once. The furthest hit comes first.
  void multi_intersect();
  // Inserts points until D_q is a disk, or a half disk on the boundary, for every vertex q.
  void extract_manifold();
  // Inserts surface points until every facet meets the criteria or is below their floors. `poles`:
  // per vertex, or empty. A new vertex gets the mean pole height of its neighbors.
  void approximate_geom(const Criteria& criteria, std::vector<double>& poles);
  // Counts the faults that remain.
  void count_unresolved();

 private:
  // Inserts x, an effective hit of r, or splits the boundary edge that x encroaches upon. Forgets
  // r's hits if the ball of x holds a vertex.
  Attempt insert(RecordId r, const Vec3& x);
  Attempt try_insert(RecordId r, const Vec3& x);
  // Splits the chain edge from a to its next vertex, then the edges that a new vertex encroaches
  // upon. Returns false if nothing was split.
  bool split_edge(SiteId a);
  // Returns the chain vertices of the zone's cells.
  std::vector<SiteId> boundary_vertices(const ConflictZone& zone) const;
  // Returns the chain edges at `near` whose balls hold p, by their first vertices.
  std::vector<SiteId> encroached_edges(const Vec3& p, std::span<const SiteId> near) const;
  // True if a vertex encroaches upon the chain edge from a to its next vertex.
  bool is_encroached(SiteId a);
  void after_insertion();
  bool is_manifold_at(SiteId q);
  // Gives the first vertex without a pole height the mean over its neighbors in Del S|Sigma.
  void estimate_pole(std::vector<double>& poles);
  void queue_vertex(SiteId v);

  const BoundaryCurves& curves_;
  const Parameters& parameters_;
  Observer* const follower_;
  Steps steps_;
  Report& report_;
  RestrictedDelaunay restricted_;
  SiteChain chain_;       // of its vertices
  double min_ball_;       // radius of the smallest ball whose center is inserted
  double shortest_edge_;  // shorter boundary edges are not split

  // The vertices whose D_q is to be tested. Insertions after extract_manifold() refill it.
  std::deque<SiteId> vertex_queue_;
  std::vector<std::uint8_t> vertex_queued_;
  std::vector<RecordId> created_;  // by all vertices that the last insert() added
  std::vector<RecordId> star_;
  std::vector<Triangle> triangles_;
};

// Runs Recover of Figure 4, ComputePoles and BuildTriMesh, and returns the mesh. With
// `single_stage` it also does all refinement, on the triangulation: the baseline of Table 2.
SurfaceMesh recover_paper(const Isosurface& surface, const BoundaryCurves& curves,
                          FirstSample first, const Parameters& parameters, bool single_stage,
                          Report& report);

}  // namespace deliso
