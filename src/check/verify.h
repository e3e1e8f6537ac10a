// SPDX-License-Identifier: MIT
// Proves, or names what is wrong with, a mesh of an isosurface: given the mesh and the volume
// alone, whoever made it. It shares no path with the stages, only the exact predicates, the oracle,
// the exact contour and the Delaunay triangulation.
//
// One mistake is to be one fault, so each part is only asked what the parts before leave open:
//   V1  vertices at one position count as one from the first (smallest) id on, after being named;
//   V2  degenerate and doubled triangles are named, then left out;
//   V3  a component with faulty edges or vertices has no topology: it is not compared;
//   V4  vertices of extra components are not asked whether they lie on Sigma;
//   V5  the restricted share is always measured, but judged on request alone, and only where
//   nothing
//       else is wrong.
// A stage may be told to leave criteria unmet (below r_min, or where it has no room): they are
// counted, and a fault only on request.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/topology_counts.h"
#include "check/boundary_quality.h"
#include "check/delaunay_share.h"
#include "check/distances.h"
#include "check/faults.h"
#include "contour/contour.h"
#include "mesh/quality.h"
#include "mesh/tri_mesh.h"
#include "volume/volume.h"

namespace deliso {

struct VerifyOptions {
  ComponentChoice components;   // others of the contour may be missing
  double position_error = 0;    // of the vertices, as far as they were rounded; scaled frame
  double restricted_share = 0;  // the least share of restricted Delaunay facets that is no fault
  // What triangles are held to, with h from the circumcenter to Sigma. How many are over a limit is
  // counted, and no fault. Points of the mesh further than max_distance from Sigma are counted too,
  // and points of Sigma further than twice that from the mesh (as Stage 2 has it).
  Criteria limits;
  bool require_distance = false;  // these points are faults, but for those that r_min allows
  int threads = 1;
  std::function<void(double)> progress;  // called with the share that is done; may be empty
  bool solid = false;  // the mesh is to be closed on the box; what is said of it holds without caps
};

// What the triangles on the box are, of a solid. The surface is verified without them.
struct SolidSummary {
  std::size_t cap_vertices = 0;  // of no triangle of the surface
  std::size_t cap_triangles = 0;
  double volume = 0;
  std::size_t self_intersections = 0;  // pairs of triangles with at least one of the caps
  double off_box = 0;                  // the largest distance of a cap's corner from the box
  MeshQuality quality;                 // of the caps
};

struct Verification {
  Faults faults;
  std::size_t vertices = 0, triangles = 0;  // as given
  std::optional<SolidSummary> solid;
  TopologyCounts mesh, exact;
  std::uint64_t equal_components = 0;  // of both, one to one, with equal topology
  std::uint64_t left_out = 0;          // components of the contour, missing as allowed
  double surface_tolerance = 0;        // scaled frame
  double max_off_surface = 0;          // of the vertices beyond it
  DelaunayShare delaunay;
  Distances to_surface;    // from points of the triangles
  Distances from_surface;  // from vertices of the exact contour
  MeshQuality quality;
  Criteria limits;  // as given
  std::size_t triangles_above_r_min = 0;
  double max_h_above_r_min = 0, max_h_over_r_above_r_min = 0;  // of those with a surface ball
  PerCriterion<std::size_t> over;                              // triangles that pass the limit
  std::size_t over_a_limit = 0;                                // any of them
  BoundaryQuality boundary;
  double seconds_validity = 0, seconds_topology = 0, seconds_delaunay = 0, seconds_distances = 0;
};

// `mesh` in the scaled frame of `volume`, kappa the effective isovalue. Faults of the mesh are in
// the result, never thrown. pre: corners below the vertex count; samples finite.
Verification verify(const TriMesh& mesh, const Volume& volume, double kappa,
                    const VerifyOptions& options);

}  // namespace deliso
