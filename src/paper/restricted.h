// SPDX-License-Identifier: MIT
// Del S|Sigma, the restricted facets of Del S, maintained under insertion.
//
// Each restricted facet has a record with its hits V_sigma cap Sigma, in order along its Voronoi
// edge. The paper's Recover spent 80-85 % of its time on these searches (§3.2). An insertion
// changes few records: Voronoi faces only shrink. A surviving facet keeps the hits that are no
// nearer to the new vertex than to its own corners. Only facets at the new vertex are searched.
//
// Two hits of one Voronoi edge closer than `delta` cancel each other. They are a ridge of the C0
// trilinear surface or a very thin sheet, and refinement there would never end. Parity stays, and
// with it the sides of Sigma. Records keep such hits; effective hits leave them out.
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
  // Searches every facet of `triangulation`. Keeps references to the surface and the report, and
  // `follower`, which may be null and receives the events of every insertion.
  RestrictedDelaunay(const Isosurface& surface, Triangulation triangulation, double delta,
                     Report& report, Observer* follower = nullptr);

  const Triangulation& triangulation() const { return triangulation_; }
  const Isosurface& surface() const { return surface_; }

  bool is_auxiliary(SiteId v) const { return deliso::is_auxiliary(triangulation_.point(v), box_); }

  std::size_t record_capacity() const { return records_.size(); }  // some are free, without hits
  // Returns a number that changes when the record is released, and so before it gets another facet.
  std::uint32_t generation(RecordId r) const { return records_[r].generation; }
  Facet facet(RecordId r) const { return records_[r].facet; }
  RecordId record(Facet f) const { return record_of_[4 * f.cell + CellId(f.index)]; }
  SiteTriangle triangle(RecordId r) const { return facet_vertices(triangulation_, facet(r)); }

  // Returns the hits without pairs that cancel, in order along the Voronoi edge. Valid until the
  // next call.
  std::span<const Vec3> effective_hits(RecordId r) const;
  // Returns the number of pairs that cancel.
  std::size_t cancelled_pairs(RecordId r) const {
    return (records_[r].hits.size() - effective_hits(r).size()) / 2;
  }
  // True if the facet is in Del S|Sigma: it has an effective hit.
  bool is_restricted(RecordId r) const { return !effective_hits(r).empty(); }
  // Returns the effective hit nearest to the facet's circumcenter. pre: is_restricted(r).
  Vec3 surface_point(RecordId r) const;

  // Sets `star` to D_q: the records of the restricted facets at q.
  void star(SiteId q, std::vector<RecordId>& star) const;

  // Returns the finite Delaunay neighbors of q, each once.
  std::vector<SiteId> neighbors(SiteId q) const;

  // Returns the conflict zone of p. The next insertion must be of p.
  const ConflictZone& prepare(const Vec3& p, CellId hint);
  // Returns the distance from p to the nearest vertex of the prepared zone. No other vertex of
  // Del S is nearer.
  double distance_to_vertices(const Vec3& p);
  // Inserts p into the prepared zone. pre: the zone has cells.
  SiteId insert_prepared(const Vec3& p);
  // Returns the corners of facets that the last insertion created, removed, or took hits from. The
  // new vertex is the first; others may occur several times.
  std::span<const SiteId> touched() const { return touched_; }
  // Returns the records that the last insertion created, or took hits from.
  std::span<const RecordId> created() const { return created_records_; }

  // Releases a record whose hits come from rounding: the Voronoi edge of an almost flat cell.
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
  // Frees the record and removes it from both sides of its facet.
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
