// SPDX-License-Identifier: MIT
// Compares a mesh with the restricted Delaunay triangulation of its vertices (paper §2.1), by a
// fresh triangulation. Tests the Voronoi edge of each facet against Sigma, also of facets that the
// mesh does not have. It takes some ten times as long as check/delaunay_share.h.
#pragma once

#include <cstddef>

#include "check/validity.h"
#include "isosurface/isosurface.h"

namespace deliso {

// What the triangulation tells of its facets and their Voronoi edges.
struct VoronoiEdges {
  bool measured = true;        // else all else is 0
  std::size_t delaunay = 0;    // triangles of the mesh that are facets
  std::size_t restricted = 0;  // of these: the Voronoi edge meets Sigma
  std::size_t missing = 0;     // restricted facets that are not in the mesh
  std::size_t multiple = 0;    // Voronoi edges that meet Sigma more than once
};

// Bound on the cells created or walked through for each vertex, on average. Vertices spread over a
// surface need about forty. Those of a helix seen from its axis, or around a center, would need as
// many as there are vertices.
inline constexpr std::size_t kMaxCellsPerVertex = 96;

// Triangulates the vertices, with auxiliary ones around them, and counts. Does not measure if all
// vertices lie in one plane with the auxiliary ones, or if there are too many cells. The result is
// the same for any number of threads.
VoronoiEdges count_voronoi_edges(const CleanMesh& mesh, const Isosurface& surface, int threads = 1);

}  // namespace deliso
