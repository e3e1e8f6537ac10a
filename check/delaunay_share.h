// SPDX-License-Identifier: MIT
// Measures how much of a mesh is the restricted Delaunay triangulation of its vertices (paper
// §2.1), without that triangulation. A triangle is a facet of it exactly if some ball through its
// corners holds no other vertex, and a restricted one if such a ball has its center on Sigma. The
// centers of all balls through the corners lie on the triangle's dual line. A vertex in the ball at
// center + t * normal is in all balls further on its side of the triangle: each vertex found leaves
// a shorter interval of t. So one or two balls tell nearly always.
//
// check/mesh_triangulation.h has the triangulation, for what only that can tell.
#pragma once

#include <cstddef>
#include <vector>

#include "check/validity.h"
#include "check/vertex_grids.h"
#include "isosurface/isosurface.h"

namespace deliso {

struct DelaunayShare {
  bool measured = true;  // else only `triangles` is set
  std::size_t triangles = 0;
  std::size_t delaunay = 0;    // of these: facets of the Delaunay triangulation of the vertices
  std::size_t restricted = 0;  // of these: the dual Voronoi edge meets Sigma
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

// Bound on the cells and vertices looked at for each triangle, on average. Triangles of a surface
// need about thirty. If their balls hold a large part of all vertices, the rest is given up.
inline constexpr std::size_t kMaxVerticesPerTriangle = 1u << 12;

// Measures the share. `heights` receives h of each triangle, from the circumcenter to the surface
// ball's center; infinite without a ball. The result is the same for any number of threads. pre:
// the grids are those of the mesh.
DelaunayShare measure_delaunay_share(const CleanMesh& mesh, const VertexGrids& grids,
                                     const Isosurface& surface, std::vector<double>& heights,
                                     int threads = 1);

}  // namespace deliso
