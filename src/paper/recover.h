// SPDX-License-Identifier: MIT
// Recover(Del S) of paper Figure 5 (Stage 1): points are inserted until no Voronoi edge meets Sigma
// more than once, and the facets at every vertex are a disk, or on the boundary curves a half disk
// (§3.1, §5). Queues take the place of sweeps over all facets: those that an insertion made, and
// vertices whose facets it changed, are asked again.
//
// Where a point would lie in the diametral ball of an edge of the boundary curves, that edge is
// split in its place. Else new points beside the curves have half disks, without end.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "paper/boundary_curves.h"
#include "paper/restricted.h"

namespace deliso::paper {

// The mean pole height of a facet's corners.
using PoleHeight = std::function<double(const SiteTriangle&)>;

// Del S while it grows from S_0 to S_1.
class Recovery {
 public:
  // `curves`: their points are among the sites, by the numbers of `ids`. Keeps references to the
  // options and the report.
  Recovery(RestrictedDelaunay del, const BoundaryCurves& curves, std::span<const SiteId> ids,
           const Options& options, Report& report);

  const RestrictedDelaunay& del() const { return del_; }

  void recover();
  // Counts in the report what is not as it should be.
  void count_left();

  // Inserts the furthest hit of every Voronoi edge that has several.
  void multi_intersect();
  // Inserts the furthest hit of D_q wherever D_q is no disk.
  void extract_manifold();
  // Inserts the hit of every facet above r_min with h/r > epsilon or r/l > lambda, or, where the
  // pole heights of its corners are known, r/h_sigma > epsilon2.
  void approximate_geom(double epsilon, const PoleHeight& pole = {});

 private:
  struct Item {
    Facet facet;
    SiteTriangle corners;  // it had when it was queued
  };
  // An edge of the boundary curves at a vertex.
  struct CurveEdge {
    SiteId to;
    BoxFace face;
  };

  // Calls visit(facet) for all facets of Del S|Sigma, and for those that insertions make meanwhile.
  template <class Visit>
  void for_each_facet(Visit&& visit);
  // Disk(): D_q is a disk; of a vertex on the curves a half disk that ends at its neighbors there.
  bool is_disk(SiteId q);
  // Inserts x, a hit of sigma or a point of Sigma near its cell, or splits the curve's edge that x
  // encroaches upon. False: neither.
  bool insert(Facet sigma, const Vec3& x);
  bool split(SiteId a, const CurveEdge& edge, Facet sigma);
  // D_q is empty, or a disk. Inserts a point beside q, or of a facet cycle, if there is one.
  void insert_without_hit(SiteId q);
  // D_q is empty. Returns the point of Sigma in V_q that is nearest to q on a line through q: along
  // the gradient, else the axes. It is far enough from all sites that this ends.
  std::optional<Vec3> point_beside(SiteId q);
  // Inserts p into Del S, and queues what that changed.
  void add_site(const Vec3& p);
  bool refuse(Refusal why);
  void queue(SiteId q);
  void queue(Facet f) { facets_.push_back({f, facet_vertices(del_.del(), f)}); }
  bool on_curve(SiteId q) const { return q < curve_.size() && !curve_[q].empty(); }

  RestrictedDelaunay del_;
  const Options& options_;
  Report& report_;
  Steps steps_;
  double shortest_edge_;                       // curve edges up to this are not split
  std::vector<std::vector<CurveEdge>> curve_;  // by site
  std::deque<Item> facets_;
  std::deque<SiteId> vertices_;
  std::vector<std::uint8_t> is_queued_;  // by site
  std::vector<Facet> star_;              // of the last is_disk()
};

// Returns the hit furthest from p, and that nearest to it. pre: there are hits.
const Hit& furthest(std::span<const Hit> hits, const Vec3& p);
const Hit& nearest(std::span<const Hit> hits, const Vec3& p);

// Throws InputError beyond max_vertices.
void require_few(std::size_t vertices, const Options& options);

}  // namespace deliso::paper
