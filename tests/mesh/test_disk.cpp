// SPDX-License-Identifier: MIT
// Disks, against named patches and a brute-force count.
#include "mesh/disk.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "check/check_mesh.h"
#include "mesh/meshes.h"

using namespace deliso;
using namespace deliso::test;

namespace {

bool links(const Triangles& facets) {
  Disk patch;
  patch.facets = facets;
  return patch.link();
}

// What a disk is, counted another way: consistently oriented, a manifold by check_mesh, one
// component with V - E + F = 1 and one boundary loop.
bool is_disk(const Triangles& facets) {
  std::map<VertexId, VertexId> id;
  Triangles used = facets;
  for (Triangle& t : used) {
    for (VertexId& v : t) v = id.try_emplace(v, VertexId(id.size())).first->second;
  }
  const TriMesh mesh = make_tri_mesh(some_points(id.size()), used);
  if (!check_mesh(mesh).empty()) return false;
  const MeshTopology topology = mesh_topology(mesh);
  return topology.components.size() == 1 && topology.euler() == 1 && topology.boundary_loops == 1;
}

// Checks the links of a patch against its facets.
void check_links(const Triangles& facets) {
  Disk patch;
  patch.facets = facets;
  REQUIRE(patch.link());
  std::set<std::pair<VertexId, VertexId>> directed;
  std::set<VertexId> vertices, on_rim;
  for (const Triangle& t : facets) {
    for (int i = 0; i < 3; ++i) directed.insert({t[(i + 1) % 3], t[(i + 2) % 3]});
    vertices.insert(t.begin(), t.end());
  }
  std::size_t rim = 0;
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const VertexId a = facets[f][(i + 1) % 3], b = facets[f][(i + 2) % 3];
      const std::uint32_t g = patch.across[f][i];
      REQUIRE((g == Disk::kNone) == !directed.contains({b, a}));
      if (g == Disk::kNone) {
        ++rim;
        on_rim.insert(a);
        continue;
      }
      REQUIRE(has_corner(facets[g], a));
      REQUIRE(has_corner(facets[g], b));
      REQUIRE(std::count(patch.across[g].begin(), patch.across[g].end(), f) >= 1);
    }
  }
  CHECK(patch.boundary.size() == rim);
  for (const Disk::BoundaryEdge& e : patch.boundary) {
    CHECK(facets[e.facet][(e.side + 1) % 3] == e.from);
    CHECK(facets[e.facet][(e.side + 2) % 3] == e.to);
    CHECK(patch.across[e.facet][e.side] == Disk::kNone);
  }
  CHECK(patch.inner_vertices() == vertices.size() - on_rim.size());
}

}  // namespace

TEST_CASE("a disk links, and a patch that is no disk does not") {
  for (const Triangles& disk :
       {Triangles{{0, 1, 2}}, Triangles{{4, 9, 7}, {9, 4, 2}}, one_ring(3), one_ring(9), fan(1),
        fan(8), l_shape(), Triangles{{5, 6, 7}, {6, 5, 8}, {5, 7, 9}}}) {
    CHECK(is_disk(disk));
    check_links(disk);
  }
  const Triangles pinched{{0, 1, 2}, {0, 3, 4}, {0, 5, 6}};
  Triangles two = fan(3);
  for (const Triangle& t : Triangles{{20, 21, 22}, {20, 22, 23}}) two.push_back(t);
  // A disk beside a torus, with a torus's Euler number 0: the sum is a disk's.
  Triangles disk_and_torus = torus_grid(4, 4);
  disk_and_torus.push_back({100, 101, 102});
  // Two disks and an annulus of two tori glued by an edge of none: V - E + F = 1 with two rims.
  Triangles disk_and_sphere_with_hole = annulus();
  disk_and_sphere_with_hole.push_back({100, 101, 102});
  Triangles with_handle = torus_grid(4, 4);  // a torus with a facet out, and a sphere beside it
  with_handle.pop_back();
  for (Triangle t : octahedron()) {
    for (VertexId& v : t) v = VertexId(v + 50);
    with_handle.push_back(t);
  }
  // An annulus pinched: its two rims share a vertex.
  const Triangles pinched_annulus{{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 5}};
  for (const Triangles& other : {Triangles{},
                                 annulus(),
                                 moebius_strip(),
                                 bow_tie(),
                                 pinched,
                                 two,
                                 tetrahedron(),
                                 octahedron(),
                                 pillow(),
                                 torus_grid(4, 3),
                                 two_spheres(),
                                 hourglass(),
                                 fan_of_three_on_an_edge(),
                                 duplicated_facet(),
                                 flipped_facet(),
                                 disk_and_torus,
                                 disk_and_sphere_with_hole,
                                 with_handle,
                                 pinched_annulus,
                                 Triangles{{0, 1, 2}, {0, 1, 3}},
                                 Triangles{{0, 1, 2}, {0, 1, 2}}}) {
    CAPTURE(other.size());
    CHECK_FALSE(is_disk(other));
    CHECK_FALSE(links(other));
  }
}

TEST_CASE("random patches of meshes link exactly where a brute-force count finds a disk") {
  int disks = 0, others = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    RandomMesh source(seed % 4 == 0   ? torus_grid(4, 5)
                      : seed % 4 == 1 ? octahedron()
                      : seed % 4 == 2 ? annulus()
                                      : l_shape(),
                      seed);
    for (int n = 0; n < 8; ++n) source.change();
    const TriMesh& mesh = source.mesh();
    for (int trial = 0; trial < 10; ++trial) {
      // Grown over edges from a facet, with holes; now and then with a facet from anywhere.
      std::set<FaceId> piece{FaceId(random.below(static_cast<std::uint32_t>(mesh.faces.size())))};
      const std::uint32_t steps = random.below(12);
      for (std::uint32_t n = 0; n < steps; ++n) {
        auto at = piece.begin();
        std::advance(at, random.below(static_cast<std::uint32_t>(piece.size())));
        const FaceId g = mesh.faces[*at].n[random.below(3)];
        if (g != kNoId) piece.insert(g);
      }
      if (random.below(6) == 0) {
        piece.insert(FaceId(random.below(static_cast<std::uint32_t>(mesh.faces.size()))));
      }
      Triangles facets;
      for (const FaceId f : piece) facets.push_back(mesh.faces[f].v);
      const bool expected = is_disk(facets);
      REQUIRE(links(facets) == expected);
      if (expected) check_links(facets);
      ++(expected ? disks : others);
    }
  }
  CHECK(disks > 1000);
  CHECK(others > 300);
}
