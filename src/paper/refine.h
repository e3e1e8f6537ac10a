// SPDX-License-Identifier: MIT
// Refine(Del S_1) of paper Figure 9 (Stage 2): BuildTriMesh hands the facets over to a plain mesh
// T_S, and RefineGeom inserts points there without Del S (Figure 3). Each facet keeps the point x
// nearest to its circumcenter in which its dual line meets Sigma. p encroaches upon the facet if
// the ball around x through the corners holds p. The facets that p encroaches upon, E, are found by
// a walk, and the cone D from p over E's boundary takes their place.
//
// Where E is no disk without inner vertices, p lies in the diametral ball of a boundary edge, or a
// vertex of E or beside it is nearer than r_min / 4, the insertion is refused and counted.
#pragma once

#include <vector>

#include "mesh/tri_mesh.h"
#include "paper/options.h"
#include "paper/report.h"
#include "paper/restricted.h"

namespace deliso::paper {

// T_S, with what is stored beside.
struct SurfaceMesh {
  struct Dual {
    Vec3 x;                 // without one the circumcenter
    bool on_sigma = false;  // the dual line meets Sigma
  };
  TriMesh mesh;
  IdArray<FaceId, Dual> duals;
  IdArray<VertexId, double> poles;  // pole heights; empty: not known
};

// Returns where the dual line of the facet a, b, c meets Sigma nearest to the circumcenter, no
// further than r.
SurfaceMesh::Dual find_dual(const Vec3& a, const Vec3& b, const Vec3& c, const Sigma& sigma,
                            SearchCounters& counters);

// Returns facets between sites as a mesh whose vertices are these, without duals. `poles`: of every
// site, or none.
SurfaceMesh as_mesh(const Triangulation& del, std::vector<Triangle> facets,
                    const std::vector<double>& poles);

// Returns Del S_1|Sigma as a mesh. A facet is turned by the passage of its Voronoi edge, which
// leaves Sigma's inside at x; one with several hits as its neighbors are.
SurfaceMesh build_tri_mesh(const RestrictedDelaunay& del, const std::vector<double>& poles);

// Inserts x of every facet with r > r_min and h/r > epsilon1, r/h_sigma > epsilon2 or r/l > lambda,
// until there is none. Counts those left.
void refine_geom(SurfaceMesh& t, const Sigma& sigma, const Options& options, Report& report);

}  // namespace deliso::paper
