// SPDX-License-Identifier: MIT
// What a run did: seconds, points, searches, and a counter for everything that was refused or left
// unresolved. A clean run shows zeros; nothing is dropped without being counted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "isosurface/isosurface.h"

namespace deliso {

enum class Counter : std::uint8_t {
  // Stage 1
  seeds_skipped,            // seeds closer than r_min to another point
  components_skipped,       // by --min-component
  boundary_splits_recover,  // boundary edges split because a point encroached upon them
  cancelled_pairs,          // two hits closer than r_min on one Voronoi edge, both ignored
  bogus_hits,               // hits whose ball holds a vertex: the Voronoi edge was garbage
  capped_insertions,        // insertions refused by the hard cap
  unresolved_facets,        // facets that still meet Sigma more than once
  unresolved_vertices,      // vertices whose facets are neither a disk nor an allowed half disk
  facets_closed,            // facets put back where a thin wedge meets the box
  components_put_back,      // components the tests lost, taken from the exact contour
  uncertified_sites,        // sites that break the certificate with no vertex of T left to insert
  unready_facets,           // facets handed over whose dual line misses Sigma within r
  needles_collapsed,        // edges at the box too short for any triangle above r_min
  // Stage 2, refused insertions by reason
  refused_not_a_disk,        // the encroached facets are not a disk with all vertices on its rim
  refused_no_surface_point,  // a new facet's dual line misses Sigma
  refused_too_close,         // the point is too near to a vertex of the rim
  refused_boundary,          // a boundary edge encroached upon that cannot be split
  refused_crossing,          // a new facet would cross another (crossing_guard.h)
  boundary_splits_refine,
  unrefined_facets,  // facets that still violate a criterion because their point was refused
  // --cap
  cap_edges_lifted,       // edges and triangles within a face of the box, given a vertex off it
  cap_lifts_off_surface,  // those of them that found no point of Sigma
  cap_edges_split,        // boundary edges that crossed another one
  cap_refused,            // cap triangles kept as they are, for the boundary edges next to them
  count_
};
inline constexpr std::size_t kCounterCount = static_cast<std::size_t>(Counter::count_);
std::string_view name_of(Counter counter);  // "cancelled_pairs", ...

// With --cap: the surface is what comes first in the mesh, the caps follow.
struct CapReport {
  std::size_t surface_vertices = 0, surface_triangles = 0;
  std::string failure;  // why the mesh stayed open; empty: it is closed
};

struct Report {
  // Seconds, wall clock, per step.
  double seconds_tree = 0;
  double seconds_contour = 0;  // T, and its boundary curves
  double seconds_init = 0;     // the paper's way: S_0
  double seconds_labels = 0;   // certified: first sites, their triangulation, labels of T
  double seconds_recover = 0;  // the rest of Stage 1
  double seconds_poles = 0, seconds_refine = 0;
  double seconds_trouble = 0;  // certified: the search for what Stage 2 left
  double seconds_cap = 0, seconds_total = 0;
  // Certified: how often Stage 1 and Stage 2 took turns. All else here but seconds and searches is
  // of the turn whose mesh was kept.
  std::size_t turns = 0;
  std::size_t troubled_facets = 0, crossing_pairs = 0;  // what was left then (trouble.h)
  std::size_t points_initial = 0;                       // S_0
  std::size_t points_recovered = 0;                     // n_RC: all points when Stage 1 ends
  std::size_t points_refined = 0;                       // n_RF: points inserted by Stage 2
  SearchCounters searches_recover, searches_refine;
  std::size_t insertions_recover = 0, insertions_refine = 0;  // in all turns
  double kappa_effective = 0;  // lowered where samples or saddles equal the isovalue
  double r_min = 0;            // scaled frame
  bool stopped_at_max_vertices = false;
  CapReport cap;
  std::array<std::uint64_t, kCounterCount> counters{};

  std::uint64_t& operator[](Counter c) { return counters[static_cast<std::size_t>(c)]; }
  std::uint64_t operator[](Counter c) const { return counters[static_cast<std::size_t>(c)]; }
};

}  // namespace deliso
