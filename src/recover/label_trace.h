// SPDX-License-Identifier: MIT
// What the certified way tells a trace: why a vertex of T becomes a site, the vertices of T that it
// takes, and the facets of K, the dual of the labels, that go and come with that.
#pragma once

#include <span>
#include <vector>

#include "recover/certificate.h"
#include "recover/labels.h"
#include "stage1/cell_trace.h"

namespace deliso {

class LabelTrace {
 public:
  // Keeps references. The first labels are there.
  LabelTrace(Trace& trace, const ContourMesh& contour, const ContourGraph& graph,
             const Labels& labels, const Triangulation& triangulation, const Box3& box,
             const Report& report);

  // Why the vertex v of T is to be a site; the one that asks, or kNoId.
  void asks(Routine routine, Reason reason, VertexId site, VertexId v);
  // `facets`: those of K at the site.
  void verdict_asks(const Verdict& verdict, VertexId site, std::span<const DualFacet> facets,
                    double fingers);
  void begin_insertion(const Vec3& p, const ConflictZone& zone);
  // It is one, and has its vertices of T.
  void added(VertexId site);
  // Stage 1 is done.
  void end() { cells_.keep_cells(triangulation_); }

 private:
  // T of more triangles is not shown.
  static constexpr std::size_t kMostTriangles = 400'000;

  bool shows_contour() const { return contour_.triangles.size() <= kMostTriangles; }

  const ContourMesh& contour_;
  const ContourGraph& graph_;
  const Labels& labels_;
  const Triangulation& triangulation_;
  CellTrace cells_;
  std::vector<VertexId> label_;  // of every vertex of T, before the site that is being added
};

}  // namespace deliso
