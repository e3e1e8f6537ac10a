// SPDX-License-Identifier: MIT
// Stage 1, Recover(Del S) of paper Figure 5: points are added until Del S|Sigma is a manifold of
// facets that follow the surface roughly.
//
// Differs from the paper in: worklists instead of sweeps; an insertion that encroaches upon an edge
// of the boundary chain splits that edge instead; what cannot be resolved is counted, not looped
// on. What its tests cannot see, it loses: a component within its own Voronoi cells, one smaller
// than r_min, a wedge at the box too thin for a Voronoi edge. The report shows it, none is mended.
#pragma once

#include <deque>
#include <vector>

#include "paper/restricted.h"
#include "stage1/first_sample.h"
#include "surface/observer.h"

namespace deliso {

// Everything Stage 1 works on, and its one way of adding points.
class Recovery {
 public:
  // What is passed by reference must outlive it.
  Recovery(const Isosurface& surface, const BoundaryCurves& curves, FirstSample first,
           const Parameters& parameters, Report& report);
  const RestrictedDelaunay& restricted() const { return restricted_; }
  const SiteChain& chain() const { return chain_; }

  // Figure 5.
  void recover();
  // What follows is the stage called so.
  void begin(const char* stage) {
    begin_stage(parameters_.observer, stage);
    steps_ = Steps(parameters_.observer);
  }

  // Splits edges of the boundary chain until none has a vertex in its diametral ball.
  void protect_boundary();
  // Inserts points until no Voronoi edge meets Sigma more than once (the furthest hit first).
  void multi_intersect();
  // Inserts points until D_q is a disk, or a half disk on the boundary, for every vertex q.
  void extract_manifold();
  // Inserts surface points until every facet with r > r_min passes the criteria. `poles` (per
  // vertex; empty: not used) grows with the vertices, each new one the mean of its neighbors'.
  void approximate_geom(const Criteria& criteria, std::vector<double>& poles);
  // Counts what the tests would still object to.
  void count_unresolved();

 private:
  // Inserts x, an effective hit of r, or splits the boundary edge it encroaches upon; forgets r's
  // hits when x's ball holds a vertex.
  Attempt insert(RecordId r, const Vec3& x);
  Attempt try_insert(RecordId r, const Vec3& x);
  // Splits the chain's edge from a to its next; then those that the new vertex encroaches upon.
  bool split_edge(SiteId a);
  // The vertices of the chain that the cells of a zone have.
  std::vector<SiteId> boundary_vertices(const ConflictZone& zone) const;
  // The edges at these whose balls hold p, by their first vertices.
  std::vector<SiteId> encroached_edges(const Vec3& p, std::span<const SiteId> near) const;
  bool edge_holds_a_vertex(SiteId a);
  void after_insertion();
  bool is_manifold_at(SiteId q);
  // The mean pole height over the neighbors in Del S|Sigma of the first vertex that has none yet.
  void estimate_pole(std::vector<double>& poles);
  void queue_vertex(SiteId v);

  const BoundaryCurves& curves_;
  const Parameters& parameters_;
  Observer* const follower_;
  Steps steps_;
  Report& report_;
  RestrictedDelaunay restricted_;
  SiteChain chain_;       // of its vertices
  double floor_;          // no ball smaller than this gets its point
  double shortest_edge_;  // no shorter boundary edge is split

  // Whose D_q is to be looked at: what extract_manifold() leaves empty, later insertions fill.
  std::deque<SiteId> vertex_queue_;
  std::vector<std::uint8_t> vertex_queued_;
  std::vector<RecordId> created_;  // by what insert() last did, of all vertices that it took
  std::vector<RecordId> star_;
  std::vector<Triangle> triangles_;
};

// Recover of Figure 4, ComputePoles and BuildTriMesh, with which Figure 9 begins (or, with
// `single_stage`, all refinement on the triangulation too: the baseline of Table 2).
SurfaceMesh recover_paper(const Isosurface& surface, const BoundaryCurves& curves,
                          FirstSample first, const Parameters& parameters, bool single_stage,
                          Report& report);

}  // namespace deliso
