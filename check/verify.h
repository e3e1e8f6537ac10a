// SPDX-License-Identifier: MIT
// Verifies a mesh of an isosurface from the mesh and the volume alone, and reports its faults. It
// shares no path with the stages, except the exact predicates, the oracle and the exact contour; on
// request the Delaunay triangulation.
//
// One mistake is reported as one fault. So each step tests only what the steps before leave open:
//   V1  Vertices at one position are reported, then count as one from the smallest id on.
//   V2  Degenerate and duplicate triangles are reported, then left out.
//   V3  A component with faulty edges or vertices has no topology: it is not compared.
//   V4  Vertices of extra components are not tested for lying on Sigma.
//   V5  The share of restricted Delaunay facets is always measured. It is a fault only on request,
//       and only if there is no other. So are triangles over a limit.
//   V6  Needles are in no fold, and corners of needles and folds are no near vertices.
//   V7  Triangles with a vertex off Sigma, or of extra components, are not off the surface too.
// A stage may leave criteria unmet (below r_min, or without room), so these are counted.
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
#include "check/delaunay_share.h"
#include "check/distances.h"
#include "check/faults.h"
#include "check/mesh_triangulation.h"
#include "check/quality.h"
#include "contour/contour.h"
#include "mesh/tri_mesh.h"
#include "volume/volume.h"

namespace deliso {

// The least tolerance of vertices.
inline constexpr double kToleranceVoxels = 1e-6;

struct VerifyOptions {
  ComponentChoice components;  // other components of the contour may be missing
  // How far a vertex may be from Sigma, if that is more than kToleranceVoxels (app/bring_home.h);
  // scaled frame. On the box is a vertex only exactly.
  double tolerance = 0;
  // Vertices as far off Sigma are counted, but are no fault: those of a mesh that does not claim to
  // lie on it. 0: there are none.
  double allowed_off_surface = 0;
  double restricted_share = 0;  // the least share of restricted Delaunay facets that is no fault
  // The limits on triangles, with h from the circumcenter to Sigma. Triangles over a limit are
  // counted. Also counted are points of the mesh further than max_distance from
  // Sigma, and points of Sigma further than twice that from the mesh (as in Stage 2).
  Criteria limits;
  // The largest share of triangles over a limit that is no fault. Two triangles never are, unless
  // they are further from Sigma than a voxel too. At 1 limits are only counted against.
  double most_over_limit = 1;
  bool require_distance = false;  // these points are faults, unless r_min allows them
  int threads = 1;
  std::function<void(double)> progress;  // called with the share done; may be empty
  bool triangulate = false;  // also count Voronoi edges, which takes as long as all else
  bool solid = false;        // the mesh must be closed on the box; its figures exclude caps
};

// The caps of a solid. The surface is verified without them.
struct SolidSummary {
  std::size_t cap_vertices = 0;  // in no triangle of the surface
  std::size_t cap_triangles = 0;
  double volume = 0;
  std::size_t self_intersections = 0;  // pairs of triangles with at least one of the caps
  MeshQuality quality;                 // of the caps
  std::size_t close_places = 0;        // count_at_caps(): no faults
};

struct Verification {
  Faults faults;
  std::size_t vertices = 0, triangles = 0;  // as given
  std::optional<SolidSummary> solid;
  TopologyCounts mesh, exact;
  std::uint64_t equal_components = 0;  // of both, one to one, with equal topology
  std::uint64_t left_out = 0;          // components of the contour, missing as allowed
  double tolerance = 0;                // scaled frame
  std::size_t off_as_allowed = 0;      // vertices off Sigma by more, as the options allow
  double max_off_surface = 0;          // of the vertices beyond the tolerance
  DelaunayShare delaunay;
  std::optional<VoronoiEdges> voronoi;  // as asked for
  Distances to_surface;                 // from points of the triangles
  Distances from_surface;  // from vertices of the exact contour, without components left out
  MeshQuality quality;
  Criteria limits;  // as given
  std::size_t triangles_above_r_min = 0;
  double max_h_above_r_min = 0, max_h_over_r_above_r_min = 0;  // of triangles with a surface ball
  PerCriterion<std::size_t> over;                              // triangles over the limit
  std::size_t over_a_limit = 0;                                // any of them
  BoundaryDistances boundary;
  double seconds_validity = 0, seconds_topology = 0, seconds_delaunay = 0, seconds_distances = 0;
};

// Verifies `mesh`, in the scaled frame of `volume`. Faults are in the result, never thrown. pre:
// kappa is the effective isovalue; corners are below the vertex count; samples are finite.
Verification verify(const TriMesh& mesh, const Volume& volume, double kappa,
                    const VerifyOptions& options);

}  // namespace deliso
