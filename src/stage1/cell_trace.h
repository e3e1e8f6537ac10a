// SPDX-License-Identifier: MIT
// What both ways of Stage 1 tell a trace: vertices and cells of Del S by the trace's numbers.
#pragma once

#include <span>
#include <vector>

#include "delaunay/triangulation.h"
#include "surface/report.h"
#include "trace/trace.h"

namespace deliso {

class CellTrace {
 public:
  // Keeps references.
  CellTrace(Trace& trace, const Box3& box, const Report& report)
      : trace_(trace), box_(box), report_(report) {}

  Trace& trace() const { return trace_; }
  // All vertices that are new; auxiliary ones have no number.
  void number_vertices(const Triangulation& t);
  // Returns kNoId for a vertex that has no number: an auxiliary one, or one that came after the
  // trace was full. Every look-up goes through here, so a caller need not ask whether it is full.
  VertexId number(VertexId v) const { return v < numbers_.size() ? numbers_[v] : kNoId; }
  Triangle number(const Triangle& v) const { return {number(v[0]), number(v[1]), number(v[2])}; }
  // The cells that p is in conflict with, before they go.
  void add_zone(const Triangulation& t, const ConflictZone& zone, const Vec3& p);
  // Ends the event.
  void record(TraceOutcome outcome);
  // Del S, at the end.
  void keep_cells(const Triangulation& t);

 private:
  bool is_told(const Triangulation& t, CellId c) const;

  Trace& trace_;
  const Box3 box_;
  const Report& report_;
  std::vector<VertexId> numbers_;
};

}  // namespace deliso
