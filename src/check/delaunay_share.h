// SPDX-License-Identifier: MIT
// Measures how much of a mesh is the restricted Delaunay triangulation of its vertices (paper
// §2.1). Makes a fresh triangulation, and tests the dual Voronoi edge of each of its facets against
// Sigma.
#pragma once

#include <cstddef>
#include <vector>

#include "check/validity.h"
#include "isosurface/isosurface.h"

namespace deliso {

struct DelaunayShare {
  bool measured = true;  // else only `triangles` is set
  std::size_t triangles = 0;
  std::size_t delaunay = 0;    // of these: facets of the Delaunay triangulation of the vertices
  std::size_t restricted = 0;  // of these: the dual Voronoi edge meets Sigma
  std::size_t missing = 0;     // restricted facets that are not in the mesh
  std::size_t multiple = 0;    // Voronoi edges that meet Sigma more than once
  std::size_t occupied = 0;    // triangles whose surface ball holds a vertex
  std::size_t without_ball =
      0;  // triangles whose dual line misses Sigma within kBallLimitRadii * r
  // Ids of the first few triangles that are not restricted Delaunay facets.
  std::vector<FaceId> first_outside;

  double share() const {
    return triangles == 0 ? 1 : static_cast<double>(restricted) / static_cast<double>(triangles);
  }
};

// Circumradii. A surface ball is centered at the point of Sigma on the triangle's dual line nearest
// to its circumcenter, if that is at most this far away.
inline constexpr double kBallLimitRadii = 4;

// Bound on the cells created or walked through for each vertex, on average. Vertices spread over a
// surface need about forty. Those of a helix seen from its axis, or around a center, would need as
// many as there are vertices.
inline constexpr std::size_t kMaxCellsPerVertex = 96;

// Measures the share. Four auxiliary vertices far outside represent infinity. Not measured if all
// vertices lie in one plane with them, or if the triangulation needs too many cells. The result is
// the same for any number of threads.
DelaunayShare measure_delaunay_share(const CleanMesh& mesh, const Isosurface& surface,
                                     int threads = 1);

// Returns h of each triangle, from the circumcenter to the surface ball's center; infinite without
// a ball.
std::vector<double> surface_heights(const CleanMesh& mesh, const Isosurface& surface,
                                    int threads = 1);

}  // namespace deliso
