// SPDX-License-Identifier: MIT
// The record of a run: seconds, points, searches, and a counter for everything that was refused or
// left unresolved. A clean run shows zeros. The stages write it, and read nothing of it but the
// isovalue.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/topology_counts.h"
#include "isosurface/isosurface.h"

namespace deliso {

enum class Counter : std::uint8_t {
  // Stage 1
  components_skipped,  // by --min-component
  voxels_cut,          // voxels in which the exact contour was made of cells
  voxels_crossed,      // voxels in which triangles of it cross all the same
  unready_facets,      // facets handed over whose dual line misses Sigma within r
  coarsened_again,     // coarsenings made again because the mesh came to cross itself
  // Stage 2
  unrefined_facets,  // facets left that violate a criterion
  points_far,        // vertices of T left further from the mesh than asked for
  // --cap
  cap_edges_lifted,       // edges and triangles within a face of the box, given a vertex off it
  cap_lifts_off_surface,  // those of them that found no point of Sigma
  cap_not_lifted,         // vertices, edges and triangles that had to stay in a face of the box
  cap_refused,            // cap triangles kept as they are, for the boundary edges next to them
  count_
};
inline constexpr std::size_t kCounterCount = static_cast<std::size_t>(Counter::count_);
inline constexpr std::array<std::string_view, kCounterCount> kCounterNames{
    "components_skipped",    "voxels_cut",       "voxels_crossed", "unready_facets",
    "coarsened_again",       "unrefined_facets", "points_far",     "cap_edges_lifted",
    "cap_lifts_off_surface", "cap_not_lifted",   "cap_refused"};
static_assert(!kCounterNames.back().empty());

// The operations of Stage 2, and why one is refused: by a gate (refine/refinement.h), or by the
// operation itself.
enum class Operation : std::uint8_t {
  surface_point,
  foot,
  boundary_split,
  flip,
  collapse,
  move,
  far_point,
  removal,
  count_
};
enum class Refusal : std::uint8_t {
  not_a_disk,        // G1, or the facets of the cavity are no disk
  swallows_vertex,   // an insertion itself: its cavity has a vertex inside
  no_surface_point,  // G3
  other_sheet,       // G3
  too_close,         // an insertion itself: to a vertex of its cavity
  boundary,          // an operation itself: on the box; or it would collapse an inserted vertex
  turned,            // G2
  no_gain,           // G4, or the operation itself: its quantity would not fall
  uncovers,          // G4: of a removed vertex
  crossing,          // G5
  frozen,            // G0, or the operation itself
  count_
};
inline constexpr std::size_t kOperations = static_cast<std::size_t>(Operation::count_);
inline constexpr std::size_t kRefusals = static_cast<std::size_t>(Refusal::count_);
inline constexpr std::array<std::string_view, kOperations> kOperationNames{
    "surface_point", "foot", "boundary_split", "flip", "collapse", "move", "far_point", "removal"};
inline constexpr std::array<std::string_view, kRefusals> kRefusalNames{
    "not_a_disk", "swallows_vertex", "no_surface_point", "other_sheet", "too_close", "boundary",
    "turned",     "no_gain",         "uncovers",         "crossing",    "frozen"};
static_assert(!kOperationNames.back().empty() && !kRefusalNames.back().empty());

constexpr std::string_view name_of(Counter counter) {
  return kCounterNames[static_cast<std::size_t>(counter)];
}
constexpr std::string_view name_of(Operation operation) {
  return kOperationNames[static_cast<std::size_t>(operation)];
}
constexpr std::string_view name_of(Refusal refusal) {
  return kRefusalNames[static_cast<std::size_t>(refusal)];
}

struct OperationCounts {
  std::uint64_t done = 0;
  std::array<std::uint64_t, kRefusals> refused{};

  // Counts the outcome of an operation and returns it.
  std::optional<Refusal> count(std::optional<Refusal> refusal) {
    ++(refusal ? refused[static_cast<std::size_t>(*refusal)] : done);
    return refusal;
  }
  OperationCounts& operator+=(const OperationCounts& others) {
    done += others.done;
    for (std::size_t k = 0; k < kRefusals; ++k) refused[k] += others.refused[k];
    return *this;
  }
};

// With --cap. The surface comes first in the mesh; the caps follow.
struct CapReport {
  std::size_t surface_vertices = 0, surface_triangles = 0;
  std::string failure;  // why the mesh stayed open; empty if it is closed
};

struct Report {
  // Seconds, wall clock, per step.
  double seconds_contour = 0;  // T, and its boundary curves
  double seconds_coarsen = 0;  // Stage 1
  double seconds_refine = 0;   // Stage 2
  double seconds_cap = 0, seconds_total = 0;
  std::size_t vertices_coarsened = 0;  // when Stage 1 ends
  SearchCounters searches_coarsen, searches_refine;
  std::size_t insertions_refine = 0;
  std::size_t vertices_refined = 0, triangles_refined = 0;  // when Stage 2 ends
  TopologyCounts exact;                                     // of the exact contour, whole
  double kappa_effective = 0;                               // geometric_isovalue()
  double r_min = 0;                                         // scaled frame, as all lengths here
  double largest_h = 0;     // of facets above r_min, when Stage 2 ended
  double max_distance = 0;  // the bound on h then: the option's, or what --vertices reached
  CapReport cap;
  std::array<std::uint64_t, kCounterCount> counters{};
  std::array<OperationCounts, kOperations> operations{};

  // Adds the seconds and counts of a block or of a part of a mesh.
  void add(const Report& part) {
    for (const auto seconds :
         {&Report::seconds_contour, &Report::seconds_coarsen, &Report::seconds_refine}) {
      this->*seconds += part.*seconds;
    }
    vertices_coarsened += part.vertices_coarsened;
    searches_coarsen += part.searches_coarsen;
    searches_refine += part.searches_refine;
    insertions_refine += part.insertions_refine;
    for (std::size_t n = 0; n < kCounterCount; ++n) counters[n] += part.counters[n];
    for (std::size_t n = 0; n < kOperations; ++n) operations[n] += part.operations[n];
  }

  std::uint64_t& operator[](Counter c) { return counters[static_cast<std::size_t>(c)]; }
  std::uint64_t operator[](Counter c) const { return counters[static_cast<std::size_t>(c)]; }
  OperationCounts& operator[](Operation r) { return operations[static_cast<std::size_t>(r)]; }
  const OperationCounts& operator[](Operation r) const {
    return operations[static_cast<std::size_t>(r)];
  }
};

}  // namespace deliso
