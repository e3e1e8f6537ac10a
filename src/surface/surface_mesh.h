// SPDX-License-Identifier: MIT
// The mesh that both stages share, the T_S of paper §3.2. It has facets, their duals, and the chain
// of boundary vertices.
//
// Invariants of live facets, beside those of mesh/tri_mesh.h.
//   S1  facet f has dual f, and its surface ball passes through its corners;
//   S2  the chain's edges are the mesh's boundary edges;
//   S3  in a face of the box are vertices and edges of the chain alone, and no facet. So caps there
//       meet the mesh along its boundary, and two blocks share their seam and nothing else.
#pragma once

#include <vector>

#include "base/box3.h"
#include "base/triangle.h"
#include "mesh/tri_mesh.h"
#include "run/criteria.h"
#include "surface/boundary.h"

namespace deliso {

// The dual of a facet: its surface ball B_sigma, centered where the facet's dual line meets Sigma.
// If the line misses Sigma, the center is the circumcenter and on_surface is false.
struct Dual {
  Vec3 center;
  double radius2 = 0;
  bool on_surface = false;

  // True if `p` is nearer to the center than the facet's corners, by more than rounding.
  bool holds(const Vec3& p) const { return distance2(center, p) < kInside * radius2; }
  static constexpr double kInside = 1 - 2e-9;
};

struct SurfaceMesh {
  TriMesh mesh;
  IdArray<FaceId, Dual> duals;
  BoundaryChain chain;

  // Returns the measures of a facet; without a surface point h is r.
  FacetShape shape(const Triangle& v, const Dual& dual) const;
  // S3, of an edge within the mesh, and of a facet: true if it would lie in a face of the box.
  bool joins_on_box(VertexId a, VertexId b, const Box3& box) const {
    return (chain.is_boundary(a) || chain.is_boundary(b)) &&
           on_one_face(mesh.points[a], mesh.points[b], box);
  }
  bool lies_on_box(const Triangle& v, const Box3& box) const {
    const auto faces = [&](VertexId u) { return box_faces_at(mesh.points[u], box); };
    return (faces(v[0]) & faces(v[1]) & faces(v[2])) != 0;
  }
  // True if v is not on the chain, or may go: it is no point that every chain must have, nor of a
  // loop of three, and no chord comes along a seam.
  bool may_remove(VertexId v, const BoundaryCurves& curves) const;
  // Keeps no room for more.
  void shrink_to_fit();
};

// Return the dual of a facet whose line meets Sigma at x, or misses Sigma.
Dual dual_at(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x);
Dual dual_without_surface(const Vec3& a, const Vec3& b, const Vec3& c);

// Sets `facets` to E: the facets, connected to `start`, whose surface balls hold p (paper §2.2.2).
void facets_encroached(const SurfaceMesh& surface, FaceId start, const Vec3& p,
                       std::vector<FaceId>& facets);

// True if S2 holds. pre: there are no dead facets.
bool ends_on_chain(const SurfaceMesh& surface);

// Removes dead facets, and vertices without facets. The rest keep their order.
void remove_dead(SurfaceMesh& surface);

}  // namespace deliso
