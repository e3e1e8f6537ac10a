// SPDX-License-Identifier: MIT
// Measures how much of a mesh is the restricted Delaunay triangulation of its vertices (paper
// §2.1). Makes a fresh triangulation, and tests the dual Voronoi edge of each of its facets against
// Sigma.
#pragma once

#include <cstddef>
#include <vector>

#include "check/free_space.h"
#include "check/validity.h"
#include "delaunay/triangulation.h"
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

// The Delaunay triangulation of a mesh's vertices, with auxiliary ones.
class MeshTriangulation {
 public:
  MeshTriangulation(const CleanMesh& mesh, const Box3& box);

  // Returns false if there is none: all vertices lie in one plane with the auxiliary ones, or it
  // takes too many cells.
  bool built() const { return built_; }
  const Triangulation& cells() const { return cells_; }
  // Returns a site's vertex of the mesh; kNoId for an auxiliary one.
  VertexId vertex(SiteId site) const { return vertex_of_[site]; }
  // Returns the facet's corners in the mesh, ascending, with kNoId for auxiliary vertices.
  Triangle corners(const Facet& f) const;

 private:
  Triangulation cells_;
  std::vector<VertexId> vertex_of_;  // of the mesh
  bool built_ = false;
};

// Measures the share. Voronoi edges are compared with Sigma only outside of `free`. The result is
// the same for any number of threads.
DelaunayShare measure_delaunay_share(const CleanMesh& mesh, const MeshTriangulation& triangulation,
                                     const Isosurface& surface, const FreeSpace& free,
                                     int threads = 1);

// Returns h of each triangle, from the circumcenter to the surface ball's center; infinite without
// a ball.
std::vector<double> surface_heights(const CleanMesh& mesh, const Isosurface& surface,
                                    int threads = 1);

}  // namespace deliso
