// SPDX-License-Identifier: MIT
// What the recorders of both programs share. They fill a trace from outside, by what the stages
// tell: vertices, cells and facets by the trace's own numbers, and the oracle's work so far.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "base/box3.h"
#include "delaunay/triangulation.h"
#include "isosurface/isosurface.h"
#include "paper/observer.h"
#include "recover/labels.h"
#include "view/trace/trace.h"

namespace deliso {

std::uint8_t trace_code(paper::Reason reason);

class Recording {
 protected:
  // Of a facet of the mesh; none: its dual line misses Sigma.
  using SurfacePoint = std::function<std::optional<Vec3>(FaceId)>;

  // Keeps a reference, as do the next three.
  explicit Recording(Trace& trace) : trace_(trace) {}
  // The stages begin to count.
  void run_begins(const SearchCounters& recover, const SearchCounters& refine, double r_min);
  // Stage 1 has its first sites.
  void sites_begin(const Triangulation& del, const Box3& domain);
  // Stage 2 has its mesh, which `routine` made.
  void mesh_begins(const TriMesh& mesh, Routine routine, SurfacePoint x);

  // Stage 1 by labels of T, record_labels.cpp: their first sites; why the vertex v of T shall be
  // one, by the test at `asker`; the labels and facets of K that a new site changed.
  void labels_begin(const Labels& labels, const Box3& domain);
  void asks_site(Routine routine, std::uint8_t reason, SiteId asker, ContourId v);
  void show_labels(SiteId site);

  // All sites that are new; auxiliary ones have no number.
  void number_sites();
  // Returns kNoId for a site that has no number: an auxiliary one, or one that came after the trace
  // was full. Every look-up goes through here, so that no caller need ask whether it is.
  VertexId number(SiteId v) const { return v < numbers_.size() ? numbers_[v] : VertexId(kNoId); }
  Triangle number(const SiteTriangle& v) const {
    return {number(v[0]), number(v[1]), number(v[2])};
  }
  // p is inserted, and the cells of the zone are removed.
  void tell_zone(const Vec3& p, const ConflictZone& zone);
  // Of Del S at the end of Stage 1.
  void tell_cells();

  // Facets of the mesh went, others came: the trace gets the worst distance of those there.
  void update_worst(std::span<const FaceId> gone, std::span<const FaceId> come);

  // Ends the event.
  void record(std::uint8_t outcome);
  void record(TraceOutcome outcome) { record(trace_code(outcome)); }

  Trace& target() const { return trace_; }

 private:
  Trace& trace_;
  // T of more triangles is not shown.
  static constexpr std::size_t kMostTriangles = 400'000;

  bool is_told(CellId c) const;
  void count_searches();

  const SearchCounters *recover_ = nullptr, *refine_ = nullptr;
  double r_min_ = 0;
  const Triangulation* del_ = nullptr;
  Box3 domain_;
  std::vector<VertexId> numbers_;  // by site
  const Labels* labels_ = nullptr;
  bool shows_contour_ = false;
  IdArray<ContourId, SiteId> label_;  // of every vertex of T, before the site that is being added
  const TriMesh* mesh_ = nullptr;
  SurfacePoint surface_point_;
  IdArray<FaceId, double> distance_;  // of each facet, as Report::largest_h; 0 up to r_min
  std::multiset<double> distances_;   // of the live ones
};

}  // namespace deliso
