// SPDX-License-Identifier: MIT
// What the paper's way tells a trace: who asks for an insertion, its conflict zone, and the facets
// of Del S|Sigma that go and come with it, told with the outside of Sigma in front.
#pragma once

#include <span>
#include <vector>

#include "paper/restricted.h"
#include "stage1/cell_trace.h"
#include "surface/criteria.h"

namespace deliso {

class RestrictedTrace {
 public:
  // Keeps references.
  RestrictedTrace(Trace& trace, const Box3& box, const Report& report)
      : cells_(trace, box, report) {}

  // Who asks for what follows, and why.
  void boundary_asks(VertexId from, VertexId to);
  void edge_asks(RecordId r);  // MultiIntersect
  void star_asks(VertexId q, bool on_boundary, std::span<const RecordId> star, RecordId furthest);
  void shape_asks(RecordId r, const FacetShape& shape, const Criteria& criteria);

  // Of RestrictedDelaunay.
  void begin(const RestrictedDelaunay& restricted);
  void begin_insertion(const Vec3& p, const ConflictZone& zone);
  void gone(RecordId r);
  void inserted();
  // The boundary edge from `from` is to be split instead.
  void splits(VertexId from, VertexId to);
  // Nothing was inserted.
  void ended(TraceOutcome outcome, const Vec3& x);
  // Recover is done.
  void end() { cells_.keep_cells(restricted_->triangulation()); }

 private:
  TraceEvent& asks(Routine routine, std::uint8_t reason, double value);
  void show(RecordId r);
  void tell_facet(RecordId r, TraceEvent& event) const;

  CellTrace cells_;
  const RestrictedDelaunay* restricted_ = nullptr;
  std::vector<Triangle> shown_;  // per record; kNoId: not in the complex
  TraceOutcome outcome_ = TraceOutcome::done;
};

}  // namespace deliso
