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
  VertexId number(VertexId v) const { return numbers_[v]; }
  Triangle number(const Triangle& v) const {
    return {numbers_[v[0]], numbers_[v[1]], numbers_[v[2]]};
  }
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
