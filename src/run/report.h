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

#include "base/enum_table.h"
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
  cap_refused,  // cap triangles kept as they are, for the boundary edges next to them
  count_
};
inline constexpr std::size_t kCounterCount = static_cast<std::size_t>(Counter::count_);
inline constexpr std::array<EnumRow<Counter, std::string_view>, kCounterCount> kCounterTable{{
    {Counter::components_skipped, "components_skipped"},
    {Counter::voxels_cut, "voxels_cut"},
    {Counter::voxels_crossed, "voxels_crossed"},
    {Counter::unready_facets, "unready_facets"},
    {Counter::coarsened_again, "coarsened_again"},
    {Counter::unrefined_facets, "unrefined_facets"},
    {Counter::points_far, "points_far"},
    {Counter::cap_refused, "cap_refused"},
}};
static_assert(is_in_order(kCounterTable));

// The operations of Stage 2, and the figure of the paper that has one.
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
inline constexpr std::size_t kOperations = static_cast<std::size_t>(Operation::count_);
struct OperationRow {
  Operation value;
  std::string_view name, figure, text;
};
inline constexpr std::array<OperationRow, kOperations> kOperationTable{{
    {Operation::surface_point, "surface_point", "9",
     "RefineGeom: the facet's surface point is inserted; the facets whose balls hold it, the disk "
     "E, give way to the cone D"},
    {Operation::foot, "foot", "", "another point of the surface near the facet is inserted"},
    {Operation::boundary_split, "boundary_split", "9",
     "an edge on the box is split at the middle of its arc"},
    {Operation::flip, "flip", "", "an edge gives way to the other diagonal of its two facets"},
    {Operation::collapse, "collapse", "", "a short edge is collapsed"},
    {Operation::move, "move", "", "a vertex moves along the surface"},
    {Operation::far_point, "far_point", "",
     "a point of the surface that is too far from the mesh is inserted"},
    {Operation::removal, "removal", "", "a vertex that no criterion needs is removed"},
}};
static_assert(is_in_order(kOperationTable));

// Why an operation is refused: by a gate (refine/refinement.h), or by the operation itself.
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
  passes_component,  // an operation itself: a merge past another component
  count_
};
inline constexpr std::size_t kRefusals = static_cast<std::size_t>(Refusal::count_);
struct RefusalRow {
  Refusal value;
  std::string_view name, text;
};
inline constexpr std::array<RefusalRow, kRefusals> kRefusalTable{{
    {Refusal::not_a_disk, "not_a_disk", "E or what takes its place is no disk"},
    {Refusal::swallows_vertex, "swallows_vertex", "E has a vertex inside, which would go"},
    {Refusal::no_surface_point, "no_surface_point", "a new facet's dual line misses the surface"},
    {Refusal::other_sheet, "other_sheet", "the point is on another sheet of the surface"},
    {Refusal::too_close, "too_close", "the point is too near to a vertex of E"},
    {Refusal::boundary, "boundary", "a boundary edge encroached upon that cannot be split"},
    {Refusal::turned, "turned", "an edge would be too sharp, or a component reversed"},
    {Refusal::no_gain, "no_gain",
     "the mesh would not be better, or a new facet would break a criterion"},
    {Refusal::uncovers, "uncovers", "a vertex would go that is too far from the new facets"},
    {Refusal::crossing, "crossing", "a new facet would cross another"},
    {Refusal::frozen, "frozen",
     "it would change facets of another region, and is tried again later"},
    {Refusal::passes_component, "passes_component",
     "a vertex would be merged past another component"},
}};
static_assert(is_in_order(kRefusalTable));

constexpr std::string_view name_of(Counter counter) {
  return row_of(kCounterTable, counter).words;
}
constexpr std::string_view name_of(Operation operation) {
  return row_of(kOperationTable, operation).name;
}
constexpr std::string_view name_of(Refusal refusal) {
  return row_of(kRefusalTable, refusal).name;
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
