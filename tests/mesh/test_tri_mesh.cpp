// SPDX-License-Identifier: MIT
// link_faces against a search through all pairs of sides.
#include <doctest/doctest.h>

#include "check/check_mesh.h"
#include "mesh/meshes.h"

using namespace deliso;
using namespace deliso::test;

namespace {

struct Oracle {
  std::vector<std::array<FaceId, 3>> neighbors;
  LinkResult result;
};

// Every side against every other. An edge is named by its first side, which counts it.
Oracle link_by_brute_force(const Triangles& triangles) {
  Oracle oracle;
  oracle.neighbors.assign(triangles.size(), {kNoId, kNoId, kNoId});
  const auto side = [&](std::size_t h) {
    const Triangle& t = triangles[h / 3];
    return std::pair(t[(h + 1) % 3], t[(h + 2) % 3]);
  };
  for (std::size_t h = 0; h < 3 * triangles.size(); ++h) {
    std::vector<std::size_t> same, opposite;
    bool first = true;
    for (std::size_t k = 0; k < 3 * triangles.size(); ++k) {
      if (k == h) continue;
      const auto [a, b] = side(h);
      if (side(k) == std::pair(a, b))
        same.push_back(k);
      else if (side(k) == std::pair(b, a))
        opposite.push_back(k);
      else
        continue;
      first &= k > h;
    }
    const bool loop = side(h).first == side(h).second;
    if (same.empty() && opposite.empty()) {
      ++oracle.result.boundary_edges;
    } else if (same.empty() && opposite.size() == 1 && !loop && opposite[0] / 3 != h / 3) {
      oracle.neighbors[h / 3][h % 3] = FaceId(opposite[0] / 3);
    } else {
      oracle.result.non_manifold_edges += first;
    }
  }
  return oracle;
}

void compare(const Triangles& triangles) {
  TriMesh mesh = mesh_of(triangles);
  const LinkResult result = link_faces(mesh);
  const Oracle oracle = link_by_brute_force(triangles);
  CHECK(result.boundary_edges == oracle.result.boundary_edges);
  CHECK(result.non_manifold_edges == oracle.result.non_manifold_edges);
  for (FaceId f = 0; f < triangles.size(); ++f) {
    REQUIRE(mesh.faces[f].v == triangles[f]);
    REQUIRE(mesh.faces[f].n == oracle.neighbors[f]);
  }
}

}  // namespace

TEST_CASE("triangle soups are linked as all pairs of sides say") {
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const std::uint32_t vertices = 3 + random.below(8);
    Triangles triangles(random.below(14));
    for (Triangle& t : triangles) {
      for (VertexId& v : t) v = VertexId(random.below(vertices));
    }
    compare(triangles);
  }
}

TEST_CASE(
    "spheres, tori and disks keep their linking and Euler number under random flips and splits") {
  struct Start {
    Triangles triangles;
    std::ptrdiff_t euler;
    std::size_t loops;
  };
  const Start starts[] = {{octahedron(), 2, 0},
                          {torus_grid(4, 5), 0, 0},
                          {one_ring(7), 1, 1},
                          {annulus(), 0, 2},
                          {two_spheres(), 4, 0}};
  for (const Start& start : starts) {
    for (std::uint64_t seed = 1; seed <= 25; ++seed) {
      CAPTURE(seed);
      RandomMesh mesh(start.triangles, seed);
      for (int i = 0; i < 60; ++i) {
        mesh.change();
        REQUIRE(check_mesh(mesh.mesh()) == "");
        REQUIRE(mesh.facets_are_right());
        const MeshTopology topology = mesh_topology(mesh.mesh());
        REQUIRE(topology.euler() == start.euler);
        REQUIRE(topology.boundary_loops == start.loops);
      }
      REQUIRE(mesh.mesh().faces.size() > start.triangles.size());
      compare(mesh.triangles());
    }
  }
}

TEST_CASE("neighbor_index returns the shared side") {
  const TriMesh mesh = mesh_of(torus_grid(4, 4));
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    for (int i = 0; i < 3; ++i) CHECK(neighbor_index(mesh.faces[f], mesh.faces[f].n[i]) == i);
  }
}
