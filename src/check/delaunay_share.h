// SPDX-License-Identifier: MIT
// How much of a mesh is the restricted Delaunay triangulation of its vertices (paper §2.1): a fresh
// triangulation, and the dual Voronoi edge of each of its facets held against Sigma.
#pragma once

#include <cstddef>
#include <vector>

#include "check/validity.h"
#include "isosurface/isosurface.h"

namespace deliso {

struct DelaunayShare {
  bool measured = true;  // else nothing but `triangles` is set
  std::size_t triangles = 0;
  std::size_t delaunay = 0;      // of these: facets of the Delaunay triangulation of the vertices
  std::size_t restricted = 0;    // of these: the dual Voronoi edge meets Sigma
  std::size_t missing = 0;       // restricted facets that are not in the mesh
  std::size_t multiple = 0;      // Voronoi edges that meet Sigma more than once
  std::size_t occupied = 0;      // triangles whose surface ball holds a vertex
  std::size_t without_ball = 0;  // triangles whose dual line misses Sigma within kBallLimit * r
  // Ids of the first few triangles that are not restricted Delaunay facets.
  std::vector<FaceId> first_outside;

  double share() const {
    return triangles == 0 ? 1 : static_cast<double>(restricted) / static_cast<double>(triangles);
  }
};

// A surface ball is centered at the point of Sigma on the triangle's dual line nearest to its
// circumcenter, as far as that is at most so many circumradii away.
inline constexpr double kBallLimit = 4;

// Cells that may be made or walked through for each vertex, all in all. Vertices spread over a
// surface take some forty; those of a helix seen from its axis, or around a center, would take as
// many as there are vertices.
inline constexpr std::size_t kMostCells = 96;

// Four auxiliary vertices far outside stand in for infinity. Not measured where all vertices lie in
// one plane with them, or the triangulation takes too many cells. The same with any number of
// threads.
DelaunayShare measure_delaunay_share(const CleanMesh& mesh, const Isosurface& surface,
                                     int threads = 1);

// Per triangle: h, from the circumcenter to the surface ball's center; infinite without a ball.
std::vector<double> surface_heights(const CleanMesh& mesh, const Isosurface& surface,
                                    int threads = 1);

}  // namespace deliso
