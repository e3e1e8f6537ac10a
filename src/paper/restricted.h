// SPDX-License-Identifier: MIT
// Del S|Sigma inside Del S: the facets whose Voronoi edges meet Sigma, kept true under insertion.
//
// Each such facet has a record with its surface points V_sigma cap Sigma in order along the Voronoi
// edge. An insertion changes little of this, on which the paper's Recover spent 80-85 % (§3.2).
// Voronoi faces only shrink: a surviving facet keeps the points that are no nearer to the new
// vertex than to its own corners. Only facets at the new vertex are searched.
//
// Two hits of one Voronoi edge closer than `delta` cancel each other: they are a ridge of the C0
// trilinear surface or a sheet thinner than can matter, and refining there would never end. Parity
// is kept, so the sides of Sigma are. hits() keeps them, effective hits leave them out.
//
// Invariants:
//   R1  a live facet without infinite vertex has a record iff its clipped Voronoi edge meets Sigma;
//   R2  both sides of a facet name the same record, and the record names one of the two.
#pragma once

#include <span>
#include <vector>

#include "delaunay/triangulation.h"
#include "delaunay/voronoi.h"
#include "isosurface/isosurface.h"
#include "mesh/star.h"
#include "stage1/first_sample.h"
#include "surface/observer.h"
#include "surface/report.h"

namespace deliso {

class RestrictedDelaunay {
 public:
  // Searches every facet of `triangulation`, which it takes over. The surface must outlive it, and
  // so must `follower`, if given, who is told of every insertion.
  RestrictedDelaunay(const Isosurface& surface, Triangulation triangulation, double delta,
                     Report& report, Observer* follower = nullptr);

  const Triangulation& triangulation() const { return triangulation_; }
  const Isosurface& surface() const { return surface_; }

  bool is_auxiliary(SiteId v) const { return deliso::is_auxiliary(triangulation_.point(v), box_); }

  std::size_t record_capacity() const { return records_.size(); }  // some are free, without hits
  // Changes whenever the record starts to stand for another facet.
  std::uint32_t generation(RecordId r) const { return records_[r].generation; }
  Facet facet(RecordId r) const { return records_[r].facet; }
  RecordId record(Facet f) const { return record_of_[4 * f.cell + CellId(f.index)]; }
  SiteTriangle triangle(RecordId r) const { return facet_vertices(triangulation_, facet(r)); }

  // The surface points left when close pairs have cancelled, in order along the Voronoi edge.
  // Valid until the next call.
  std::span<const Vec3> effective_hits(RecordId r) const;
  // How many pairs of hits have cancelled.
  std::size_t cancelled_pairs(RecordId r) const {
    return (records_[r].hits.size() - effective_hits(r).size()) / 2;
  }
  // The facet is in Del S|Sigma: an effective hit is left.
  bool is_restricted(RecordId r) const { return !effective_hits(r).empty(); }
  // The effective hit nearest to the facet's circumcenter. pre: is_restricted(r).
  Vec3 surface_point(RecordId r) const;

  // D_q: the records of the restricted facets at q.
  void star(SiteId q, std::vector<RecordId>& star) const;

  // The Delaunay neighbors of q, finite ones only, each once.
  std::vector<SiteId> neighbors(SiteId q) const;

  // Before p is inserted: the conflict zone, to be looked at. The next insertion must use it.
  const ConflictZone& prepare(const Vec3& p, CellId hint);
  // Distance from p to the nearest vertex of the prepared zone, which is its nearest vertex of all.
  double distance_to_vertices(const Vec3& p);
  // Inserts p into the prepared zone. pre: the zone has cells.
  SiteId insert_prepared(const Vec3& p);
  // What the last insertion touched: vertices of facets that came, went, or lost hits, some of them
  // several times, the new vertex first; and the records that came, or lost hits.
  std::span<const SiteId> touched() const { return touched_; }
  std::span<const RecordId> created() const { return created_records_; }

  // The facet's hits are the work of a garbage Voronoi edge (an almost flat cell): forget them.
  void forget(RecordId r);

 private:
  struct Record {
    Facet facet;
    std::uint32_t generation = 0;
    std::vector<Vec3> hits;
  };

  RecordId& record_slot(Facet f) { return record_of_[4 * f.cell + CellId(f.index)]; }
  void gather_cells(SiteId q) const;
  void search(Facet f);
  // Frees the record, and takes it from both sides of its facet.
  void release(RecordId r, Facet f);
  void touch(Facet f);

  const Isosurface& surface_;
  Triangulation triangulation_;
  double delta_;
  Report& report_;
  Observer* follower_;
  Box3 box_;

  std::vector<RecordId> record_of_;  // per cell and index; kNoId where Sigma is not met
  std::vector<Record> records_;
  std::vector<RecordId> free_records_;

  std::vector<SiteId> touched_;
  std::vector<RecordId> created_records_;

  ConflictZone zone_;
  std::vector<CellId> created_cells_;
  std::vector<RecordId> surviving_;
  std::vector<Hit> found_;
  mutable std::vector<Vec3> effective_;
  mutable std::vector<CellId> around_;
  mutable std::vector<std::uint32_t> cell_stamp_;
  mutable std::uint32_t around_stamp_ = 0;
};

}  // namespace deliso
