// SPDX-License-Identifier: MIT
// Splits keep neighbors, orientation and Euler number of closed and open meshes.
#include "mesh/tri_mesh.h"

#include <doctest/doctest.h>

#include "base/random.h"
#include "mesh/check_mesh.h"
#include "mesh/meshes.h"

using namespace deliso;
using namespace deliso::test;

TEST_CASE("random splits of edges keep the mesh and its linking") {
  for (const Triangles& triangles :
       {tetrahedron(), octahedron(), torus_grid(5, 4), fan(7), annulus()}) {
    Random random(7);
    TriMesh mesh = mesh_of(triangles);
    const MeshTopology before = mesh_topology(mesh);
    for (int n = 0; n < 200; ++n) {
      const FaceId f(random.below(static_cast<std::uint32_t>(mesh.faces.size())));
      const int i = static_cast<int>(random.below(3));
      const Vec3 p{random.uniform(), random.uniform(), random.uniform()};
      const std::size_t faces = mesh.faces.size();
      const bool inner = mesh.faces[f].n[i] != kNoId;
      const Triangle old = mesh.faces[f].v;
      const VertexId v = split_edge(mesh, f, i, p);
      CHECK(mesh.points[v] == p);
      CHECK(mesh.faces.size() == faces + (inner ? 2 : 1));
      const Triangle kept{old[i], old[(i + 1) % 3], v};
      CHECK(mesh.faces[f].v == kept);
    }
    CHECK(check_mesh(mesh) == "");
    TriMesh linked = mesh;
    const LinkResult links = link_faces(linked);
    CHECK(links.non_manifold_edges == 0);
    for (FaceId f = 0; f < mesh.faces.size(); ++f) CHECK(mesh.faces[f].n == linked.faces[f].n);
    const MeshTopology after = mesh_topology(mesh);
    CHECK(after.euler() == before.euler());
    CHECK(after.boundary_loops == before.boundary_loops);
    CHECK(after.components.size() == before.components.size());
  }
}
