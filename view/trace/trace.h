// SPDX-License-Identifier: MIT
// A run, insertion by insertion: what was inserted, who asked for it and why, and which facets went
// and came. For looking at a run and learning from it; nothing is decided by it.
//
// Filled by the observers of recorder.h and record_paper.h, for the exact and the published
// program. When the exact program is followed, its Stage 2 refines the mesh undivided, so that the
// order is that of paper Figure 9. The same run gives the same trace but for the times.
//
//   T1  Vertices have numbers of the trace's own, in the order in which they come. One that moves
//       is a new one.
//   T2  The complex is Stage 1's facets, of T, Del S|Sigma or the dual K of the labels, and after
//   the
//       switch those of the mesh. That of step n is what the events before n have added, less what
//       they have removed; each triangle removed was there, up to rotation.
//   T3  There are no more events than the limit; those beyond are counted. What T2 says holds for
//       those that are there.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/segment.h"
#include "base/vec3.h"
#include "mesh/tri_mesh.h"
#include "run/observer.h"

namespace deliso {

// Who inserts, in the words of paper Figures 4, 5 and 9 (view/trace/trace_names.h explains each).
enum class Routine : std::uint8_t {
  init_triangulation,
  multi_intersect,  // this and the next three: the published program
  extract_manifold,
  approximate_geom,
  certify,
  contour,  // the exact program, and how it coarsens T
  remove_vertices,
  move_vertices,
  flip_edges,
  build_tri_mesh,  // the switch
  coarsen,         // that of the exact program: T is coarsened
  count_           // then the operations of Stage 2
};

// The reasons that are not of Stage 2: those of the published program, from `region` on of its
// certified Stage 1, and the last two of coarsening.
enum class PaperReason : std::uint8_t {
  several_hits,
  no_disk,
  no_half_disk,
  r_over_pole,
  facet_cycle,
  region,
  interface,
  triple,
  boundary,
  no_area,
  off_the_middle,
  wide_angles,
  count_
};

// Of an attempt. A split is an insertion in place of that asked for; the published program has it
// and the refusals after it.
enum class TraceOutcome : std::uint8_t {
  done,
  split,
  vertex_there,
  beside_a_curve,
  no_disk,
  count_  // then the refusals of the exact program's Stage 2
};

// Their numbers in events: operations follow the routines, criteria and then the published
// program's reasons follow the reasons, refusals the outcomes.
constexpr std::uint8_t trace_code(Routine routine) {
  return static_cast<std::uint8_t>(routine);
}
constexpr std::uint8_t trace_code(Reason reason) {
  return static_cast<std::uint8_t>(reason);
}
constexpr std::uint8_t trace_code(TraceOutcome outcome) {
  return static_cast<std::uint8_t>(outcome);
}
constexpr std::uint8_t trace_code(Operation operation) {
  return static_cast<std::uint8_t>(trace_code(Routine::count_) + static_cast<unsigned>(operation));
}
constexpr std::uint8_t trace_code(Criterion criterion) {
  return trace_code(reason_of(criterion));
}
constexpr std::uint8_t trace_code(PaperReason reason) {
  return static_cast<std::uint8_t>(trace_code(Criterion::count_) + static_cast<unsigned>(reason));
}
constexpr std::uint8_t trace_code(Refusal refusal) {
  return static_cast<std::uint8_t>(trace_code(TraceOutcome::count_) +
                                   static_cast<unsigned>(refusal));
}

struct TraceEvent {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  // Who asks, and why: stays until another does.
  std::uint8_t routine = 0;
  std::uint8_t reason = 0;
  double value = kNone;                  // how far the criterion is passed, or as the reason says
  Triangle caller{kNoId, kNoId, kNoId};  // the facet that asks, or a vertex alone
  // Its Voronoi edge, within the box; of a refused operation of Stage 2 what refused it.
  std::optional<Segment> edge;
  std::optional<std::pair<Vec3, double>> ball;  // its surface Delaunay ball: center and radius
  std::vector<Vec3> hits;                       // of Sigma with the edge

  // What comes of it.
  VertexId vertex = kNoId;          // the one that came
  Vec3 place{kNone, kNone, kNone};  // where it came, or was to
  std::vector<Triangle> removed, added;
  std::vector<std::array<VertexId, 4>> zone;  // cells in conflict with it
  std::vector<Triangle> star;                 // D_q; or the disk E of an attempt
  std::vector<Triangle> cone;                 // what was to take its place; kNoId: the new vertex
  std::vector<std::array<std::uint32_t, 2>> relabel;  // vertex of T, its new site
};

// Several numbers per item, several items per event: those of event e are the items from begin[e]
// to begin[e + 1].
template <class T>
struct TraceList {
  std::vector<T> values;
  std::vector<std::uint32_t> begin{0};
};

// All events, an array for each of their parts. Points are f32 triples; NaN: there is none.
struct TraceArrays {
  std::vector<float> points;
  std::vector<std::uint8_t> routine, outcome, reason;
  std::vector<float> value, place, edge, ball;
  std::vector<std::uint32_t> vertex, caller;
  std::vector<std::uint32_t> micros;                  // since the event before
  std::vector<std::uint32_t> searches, computations;  // so far
  std::vector<float> worst;  // largest h in the mesh after the event; NaN before the switch
  TraceList<std::uint32_t> removed, added, zone, star, cone, relabel;
  TraceList<float> hits;
  std::vector<std::uint32_t> tets;  // of Del S at the switch
  // T, of the certified Stage 1, with the first site of each vertex; empty where it is too large.
  std::vector<float> contour_points;
  std::vector<std::uint32_t> contour_triangles, contour_label;
};

// Of one run.
class Trace {
 public:
  // `with_times`: the clock is read at every event.
  explicit Trace(std::size_t limit, bool with_times = true);

  // The stages fill it.
  VertexId add_vertex(const Vec3& p);
  // Somebody asks: what is said of the event before goes.
  TraceEvent& asks(std::uint8_t routine, std::uint8_t reason, double value = TraceEvent::kNone);
  TraceEvent& event() { return event_; }
  // So much the oracle has done so far.
  void count(std::uint64_t searches, std::uint64_t computations);
  // Of all facets of the mesh above r_min the largest h (Report::largest_h).
  void set_worst(double distance) { worst_ = distance; }
  // Ends the event; the next has the same who and why.
  void record(TraceOutcome outcome) { record(trace_code(outcome)); }
  void record(std::uint8_t outcome);
  // No more is recorded, and what is said of events does not matter.
  bool is_full() const { return events_seen_ >= limit_; }
  TraceArrays& arrays() { return arrays_; }

  // An event: the mesh, which `routine` made, takes the place of the facets so far. Its vertices
  // that are where there is one are that one.
  void put_mesh(const TriMesh& mesh, Routine routine);
  // From then to the end of Stage 2 vertices of the mesh have numbers of the trace.
  bool follows_mesh() const { return follows_mesh_; }
  std::vector<VertexId>& of_mesh() { return of_mesh_; }
  void end_mesh() { follows_mesh_ = false; }

  const TraceArrays& arrays() const { return arrays_; }
  std::size_t size() const { return arrays_.routine.size(); }
  std::size_t events_seen() const { return events_seen_; }
  bool truncated() const { return events_seen_ > limit_; }
  // The complex after all events, T2: each triangle begins with its smallest vertex, ascending.
  std::vector<Triangle> complex() const;
  // Where vertex v is, as it was told.
  const Vec3& point(std::uint32_t v) const { return points_[v]; }

 private:
  using Clock = std::chrono::steady_clock;
  void append_event(std::uint8_t outcome);
  std::uint32_t micros_since_last();

  std::size_t limit_, events_seen_ = 0;
  bool with_times_, follows_mesh_ = false;
  Clock::time_point last_;
  TraceEvent event_;
  std::uint64_t searches_ = 0, computations_ = 0;
  double worst_ = TraceEvent::kNone;
  std::vector<Vec3> points_;
  std::vector<VertexId> of_mesh_;
  TraceArrays arrays_;
};

}  // namespace deliso
