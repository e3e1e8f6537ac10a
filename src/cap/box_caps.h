// SPDX-License-Identifier: MIT
// Caps: the part of the box's faces where f >= kappa, triangulated so that together with the mesh
// they bound the solid {f >= kappa} within the box.
//
// The mesh's boundary edges run along the box with the inside on one known side, so they alone say
// which part of a face is inside; samples are asked only where a face has no such edge. Each face
// is a rectangle of its own (planar/), with the coordinate across it dropped; faces share the
// vertices on the edges of the box. What the result keeps:
//   C1  boundary edges of the mesh are edges of the caps, unsplit: its triangles do not change;
//   C2  new vertices lie on the planes of the box to the last bit;
//   C3  mesh and caps are closed, and run along each edge they share in opposite directions.
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
#include "planar/planar_region.h"

namespace deliso {

class BoxCaps {
 public:
  // Corner m of the box is at its high end along axis k where bit k of m is set. Keeps references.
  // pre: the mesh is linked; the box has three sides that are not 0.
  BoxCaps(const TriMesh& mesh, const Box3& box, const std::array<bool, 8>& corner_inside);

  // Boundary edges, each by the facet and the corner opposite to it.
  struct EdgeRef {
    FaceId f;
    int i;
    friend bool operator==(const EdgeRef&, const EdgeRef&) = default;
    friend bool operator<(const EdgeRef& a, const EdgeRef& b) {
      return a.f != b.f ? a.f < b.f : a.i < b.i;
    }
  };
  // Edges that meet another one, or a vertex, beyond their ends; ascending. There are no caps then.
  const std::vector<EdgeRef>& crossing_edges() const { return crossing_; }
  // Vertices of the boundary at one position. There are no caps then, either.
  const std::vector<std::pair<VertexId, VertexId>>& coincident() const { return coincident_; }
  // Why there can be no caps whatever is done about crossings; empty when there can.
  const std::string& failure() const { return failure_; }
  bool possible() const { return crossing_.empty() && coincident_.empty() && failure_.empty(); }

  // Improves the triangles: r/l <= lambda as far as boundary edges, which are kept, allow.
  // pre: possible().
  void refine(double lambda);
  std::size_t refused() const;

  // Points and triangles that close the mesh when appended to its own. pre: possible().
  const std::vector<Vec3>& new_points() const { return new_points_; }
  std::vector<Triangle> triangles() const;

 private:
  struct FaceCap {
    int number, across, u, v;  // the face, its axis, and the axes of its plane
    std::unique_ptr<ConstrainedTriangulation> plane;
    std::vector<VertexId> global;            // of its vertices, ids of the closed mesh
    std::map<VertexId, VertexId> on_sides;   // back again, for those on sides
    std::unique_ptr<RegionRefiner> refiner;  // made by refine()
  };

  void collect_boundary();
  void triangulate(FaceCap& cap);
  void obstruct(VertexId v);
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
  std::vector<EdgeRef> edges_;                         // all boundary edges
  std::vector<std::pair<VertexId, EdgeRef>> edge_at_;  // per end of each, sorted
  std::array<FaceCap, 6> caps_;
  std::vector<Vec3> new_points_;
  double shortest_ = 0;  // boundary edge
  std::vector<EdgeRef> crossing_;
  std::vector<std::pair<VertexId, VertexId>> coincident_;
  std::string failure_;
};

}  // namespace deliso
