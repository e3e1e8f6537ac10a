// SPDX-License-Identifier: MIT
// Allowed collapses keep what a mesh is; those that would not are refused, by brute force.
#include "mesh/collapse.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "base/random.h"
#include "mesh/check_mesh.h"
#include "mesh/meshes.h"
#include "mesh/split.h"

using namespace deliso;
using namespace deliso::test;

namespace {

bool same_topology(const MeshTopology& a, const MeshTopology& b) {
  return a.euler() == b.euler() && a.boundary_loops == b.boundary_loops &&
         a.components.size() == b.components.size();
}

// The mesh after the collapse, made anew from its triangles, whether or not it is one.
TriMesh merged(const TriMesh& mesh, VertexId from, VertexId to) {
  std::vector<Triangle> triangles;
  for (const Face& face : mesh.faces) {
    Triangle t = face.v;
    std::replace(t.begin(), t.end(), from, to);
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  }
  std::vector<VertexId> new_id;
  TriMesh out = make_tri_mesh(mesh.points, triangles);
  remove_dead(out, new_id);
  return out;
}

}  // namespace

TEST_CASE("collapses are allowed exactly where they keep the mesh, its topology and boundary") {
  int allowed = 0, refused = 0;
  for (const Triangles& triangles : {tetrahedron(), octahedron(), torus_grid(5, 4),
                                     torus_grid(3, 3), fan(7), annulus(), one_ring(4), l_shape()}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      Random random(seed);
      TriMesh mesh = mesh_of(triangles);
      for (std::uint64_t n = 0; n < 3 * (seed - 1); ++n) {
        const FaceId f = random.below(static_cast<std::uint32_t>(mesh.faces.size()));
        const Vec3 p{random.uniform(), random.uniform(), random.uniform()};
        if (n % 2 == 0) {
          split_face(mesh, f, p);
        } else {
          split_edge(mesh, f, static_cast<int>(random.below(3)), p);
        }
      }
      const MeshTopology before = mesh_topology(mesh);
      std::vector<bool> on_boundary(mesh.points.size(), false);
      for (const Face& face : mesh.faces) {
        for (int i = 0; i < 3; ++i) {
          if (face.n[i] != kNoId) continue;
          on_boundary[face.v[(i + 1) % 3]] = on_boundary[face.v[(i + 2) % 3]] = true;
        }
      }
      for (FaceId f = 0; f < mesh.faces.size(); ++f) {
        for (int side = 0; side < 6; ++side) {
          const int i = side % 3;
          const VertexId from = mesh.faces[f].v[(i + 1 + side / 3) % 3];
          Collapse plan;
          const bool may = plan_collapse(mesh, f, i, from, plan);
          REQUIRE(plan.from == from);
          const TriMesh expected = merged(mesh, plan.from, plan.to);
          const bool keeps = !expected.faces.empty() && check_mesh(expected).empty() &&
                             same_topology(before, mesh_topology(expected));
          const bool into_inside = on_boundary[from] && mesh.faces[f].n[i] != kNoId;
          if (!may) {
            ++refused;
            INFO("from ", plan.from, " to ", plan.to, " faces ", mesh.faces.size());
            CHECK((!keeps || into_inside));
            continue;
          }
          ++allowed;
          CHECK(keeps);
          TriMesh collapsed = mesh;
          collapse_edge(collapsed, plan);
          std::vector<VertexId> new_id;
          TriMesh linked = collapsed;
          remove_dead(linked, new_id);
          CHECK(check_mesh(linked) == "");
          CHECK(same_topology(before, mesh_topology(linked)));
          CHECK(new_id[from] == kNoId);
          CHECK(linked.points.size() == expected.points.size());
          CHECK(linked.faces.size() == expected.faces.size());
          // The neighbours that the collapse left are those that linking finds.
          const LinkResult links = link_faces(linked);
          CHECK(links.non_manifold_edges == 0);
          std::size_t open = 0;
          for (const Face& face : collapsed.faces) {
            if (is_dead(face)) continue;
            open += static_cast<std::size_t>(std::count(face.n.begin(), face.n.end(), kNoId));
            for (int k = 0; k < 3; ++k) {
              if (face.n[k] == kNoId) continue;
              const Face& g = collapsed.faces[face.n[k]];
              CHECK_FALSE(is_dead(g));
              CHECK(std::count(g.v.begin(), g.v.end(), face.v[(k + 1) % 3]) == 1);
              CHECK(std::count(g.v.begin(), g.v.end(), face.v[(k + 2) % 3]) == 1);
            }
          }
          CHECK(open == links.boundary_edges);
        }
      }
    }
  }
  CHECK(allowed > 1000);
  CHECK(refused > 500);
}
