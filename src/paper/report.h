// SPDX-License-Identifier: MIT
// What a run tells of itself: seconds, points, searches, and what was refused or left.
#pragma once

#include <cstddef>

#include "isosurface/isosurface.h"

namespace deliso::paper {

struct Report {
  double kappa = 0, r_min = 0;  // geometric_isovalue(); r_min in the scaled frame
  // Seconds of the wall clock.
  double seconds_tree = 0, seconds_init = 0, seconds_recover = 0;
  double seconds_contour = 0;  // of the certified Stage 1
  double seconds_poles = 0;    // ComputePoles
  double seconds_refine = 0;   // RefineGeom
  double seconds_total = 0;
  std::size_t points_on_lines = 0, points_on_curves = 0;      // S_0
  std::size_t insertions_recover = 0, insertions_refine = 0;  // n_RC and n_RF
  SearchCounters searches_recover, searches_refine;           // of which Table 4 is made

  std::size_t cancelled_pairs = 0;  // of hits nearer than kClosest r_min on one Voronoi edge
  std::size_t curve_splits = 0;     // edges of the boundary curves split in place of an insertion
  std::size_t curve_refusals = 0;   // insertions refused for such an edge
  std::size_t not_a_disk = 0;       // insertions refused since E is no disk
  std::size_t too_near = 0;         // and since a vertex is nearer than r_min / 4
  // Left when Recover ends: Voronoi edges with several hits, vertices whose D_q is no disk, and
  // vertices without a facet, which the mesh does not have.
  std::size_t facets_left = 0, vertices_left = 0, vertices_alone = 0;
  // Of the certified Stage 1: vertices of T, those inserted until the certificate held, and sites
  // where it does not hold.
  std::size_t contour_vertices = 0, insertions_certified = 0, uncertified_sites = 0;
  std::size_t facets_without_point = 0;  // of the mesh: the dual line misses Sigma
  std::size_t facets_unrefined = 0;      // of the mesh: a criterion does not hold

  std::size_t points_initial() const { return points_on_lines + points_on_curves; }
};

}  // namespace deliso::paper
