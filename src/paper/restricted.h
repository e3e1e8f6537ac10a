// SPDX-License-Identifier: MIT
// Del S|Sigma: the Delaunay triangulation of S, and for every facet sigma the points in which its
// Voronoi edge V_sigma meets Sigma, its hits (paper §2.2.1). The facets with a hit are Del S|Sigma.
//
// As published, every facet of every new cell is searched; that is where most of Recover's time
// goes (§3.2).
//
// Two hits of one Voronoi edge nearer than kClosest r_min cancel each other: a ridge of the
// trilinear surface, or a very thin sheet, where insertion would not end. The sides of its ends
// stay.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/segment.h"
#include "base/triangle.h"
#include "delaunay/triangulation.h"
#include "paper/intersect.h"
#include "paper/observer.h"
#include "paper/options.h"
#include "paper/report.h"

namespace deliso::paper {

class RestrictedDelaunay {
 public:
  // Searches every facet of Del S. Keeps references.
  RestrictedDelaunay(Triangulation del, Sigma& sigma, const Options& options, Report& report);

  const Triangulation& del() const { return del_; }
  Sigma& sigma() const { return sigma_; }
  bool is_auxiliary(SiteId q) const { return deliso::is_auxiliary(del_.point(q), box_); }
  // Returns V_sigma cap Sigma, in order along the dual line of facet_dual().
  std::span<const Hit> hits(Facet sigma) const { return hits_[slot(sigma)]; }
  // Returns V_sigma within the box; nothing if it is outside, or sigma has an infinite vertex.
  std::optional<Segment> voronoi_edge(Facet sigma) const;
  // Returns the cells at q. Valid until the next call, or star().
  std::span<const CellId> cells_at(SiteId q) const;
  // Sets `d_q` to D_q: the facets of Del S|Sigma at q.
  void star(SiteId q, std::vector<Facet>& d_q) const;

  // Returns the conflict zone of p. The next insertion must be of p.
  const ConflictZone& find_conflicts(const Vec3& p, CellId hint);
  // Inserts p into Del S, in its zone. pre: p is no vertex.
  SiteId insert(const Vec3& p);
  // Returns the facets of Del S|Sigma in the cells that the last insertion, or the constructor,
  // made; and the corners of those that came or went, some of them several times.
  std::span<const Facet> created() const { return created_; }
  std::span<const SiteId> touched() const { return touched_; }

 private:
  // The hits of a facet are stored at one of its two sides.
  std::size_t slot(Facet f) const;
  void search(Facet f);
  void add_touched(Facet f);

  Triangulation del_;
  Sigma& sigma_;
  const Options& options_;
  Report& report_;
  Box3 box_;
  std::vector<std::vector<Hit>> hits_;  // by slot
  ConflictZone zone_;
  std::vector<CellId> new_cells_;
  std::vector<Facet> created_;
  std::vector<SiteId> touched_;
  mutable std::vector<CellId> around_;
  mutable std::vector<std::uint32_t> seen_;  // by cell: the last cells_at() that saw it
  mutable std::uint32_t round_ = 0;
};

// How many times its limit a facet's worst measure is, and which that is (§3.2). `epsilon`: the
// limit of h/r. `pole`: the pole height; infinite where it is not asked for.
struct Violation {
  double value = 0;
  Reason reason = Reason::h_over_r;
};
Violation violation(const FacetShape& m, double epsilon, double pole, const Options& options);

// Returns the corners counter-clockwise seen from where the Voronoi edge leaves Sigma's inside at
// x.
SiteTriangle turned(SiteTriangle corners, const Hit& x);

}  // namespace deliso::paper
