// SPDX-License-Identifier: MIT
// Caps: the region of the box's faces where f >= kappa, triangulated. Together with the mesh they
// bound the solid {f >= kappa} within the box.
//
// The mesh's boundary edges run along the box with the inside on one known side. So they alone
// determine which region of a face is inside; samples decide only for a face without such edges.
// Each face is a separate rectangle (planar/), without the coordinate across it. Faces share the
// vertices on the edges of the box. The result has these properties:
//   C1  Boundary edges of the mesh are edges of the caps, unsplit: the mesh's triangles do not
//       change.
//   C2  New vertices lie on the planes of the box to the last bit.
//   C3  Mesh and caps are closed, and run along each common edge in opposite directions.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/box3.h"
#include "mesh/tri_mesh.h"
#include "more/planar/planar_region.h"

namespace deliso {

class BoxCaps {
 public:
  // Triangulates the caps. Corner m of the box is at the high end of axis k if bit k of m is set.
  // Keeps references. pre: the mesh is linked; no side of the box is 0.
  BoxCaps(const TriMesh& mesh, const Box3& box, const std::array<bool, 8>& corner_inside);

  // Returns why there are no caps; empty if there are.
  const std::string& failure() const { return failure_; }

  // Improves the triangles to r/l <= lambda, as far as boundary edges, which stay unsplit, allow.
  // pre: there are caps.
  void refine(double lambda);
  // Returns how many triangles stay bad (RegionRefiner::refused).
  std::size_t refused() const;

  // Return the points and triangles that close the mesh when appended to its own. pre: there are
  // caps.
  const std::vector<Vec3>& new_points() const { return new_points_; }
  std::vector<Triangle> triangles() const;

 private:
  struct FaceCap {
    int number, across, u, v;  // the face, its axis, and the axes of its plane
    std::unique_ptr<ConstrainedTriangulation> plane;
    std::vector<VertexId> global;            // per vertex, its id in the closed mesh
    std::map<VertexId, VertexId> on_sides;   // the inverse, for vertices on sides
    std::unique_ptr<RegionRefiner> refiner;  // made by refine()
  };

  void collect_boundary();
  void triangulate(FaceCap& cap);
  void number_corners();
  void check_sides();
  void split_side(FaceCap& cap, VertexId a, VertexId b);
  Vec3 point(VertexId global) const {
    return global < mesh_.points.size() ? mesh_.points[global]
                                        : new_points_[global - mesh_.points.size()];
  }

  const TriMesh& mesh_;
  const Box3 box_;
  const std::array<bool, 8> corner_inside_;
  std::vector<std::array<VertexId, 2>> edges_;  // of the boundary, directed as in their facets
  std::array<FaceCap, 6> caps_;
  std::vector<Vec3> new_points_;
  double shortest_ = 0;  // length of the shortest boundary edge
  std::string failure_;
};

}  // namespace deliso
