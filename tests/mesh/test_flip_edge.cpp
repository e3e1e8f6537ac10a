// SPDX-License-Identifier: MIT
// Flips keep a mesh a manifold, and on the sphere lead to the Delaunay triangulation: there it is
// the convex hull, where no flip is left to do.
#include "mesh/flip.h"

#include <doctest/doctest.h>

#include "base/random.h"
#include "base/triangle.h"
#include "mesh/check_mesh.h"

using namespace deliso;

namespace {

TriMesh octahedron() {
  return make_tri_mesh(
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      std::vector<Triangle>{
          {0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

// Splits facet f at a point of the unit sphere over it.
void split_facet(TriMesh& mesh, FaceId f) {
  std::vector<Triangle> triangles;
  for (const Face& face : mesh.faces) triangles.push_back(face.v);
  const auto [a, b, c] = triangles[f];
  const Vec3 sum = mesh.points[a] + mesh.points[b] + mesh.points[c];
  const VertexId v = VertexId(mesh.points.size());
  mesh.points.push_back(sum / length(sum));
  triangles[f] = {a, b, v};
  triangles.push_back({b, c, v});
  triangles.push_back({c, a, v});
  mesh = make_tri_mesh(std::move(mesh.points), triangles);
}

// d above the plane of a, b, c.
bool above(const TriMesh& mesh, VertexId a, VertexId b, VertexId c, VertexId d) {
  const Vec3 n = area_normal(mesh.points[a], mesh.points[b], mesh.points[c]);
  return dot(n, mesh.points[d] - mesh.points[a]) > 1e-12 * length(n);
}

}  // namespace

TEST_CASE("allowed flips at random keep the manifold; a second flip undoes the first") {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    TriMesh mesh = octahedron();
    for (int n = 0; n < 20; ++n) {
      split_facet(mesh, FaceId(random.below(static_cast<std::uint32_t>(mesh.faces.size()))));
    }
    int flips = 0, refused = 0;
    while (flips < 200) {
      const FaceId f(random.below(static_cast<std::uint32_t>(mesh.faces.size())));
      const Quad q = quad_at(mesh, f, static_cast<int>(random.below(3)));
      CHECK(q.f == f);
      if (has_diagonal(mesh, q)) {
        ++refused;
        continue;
      }
      flip_edge(mesh, q);
      ++flips;
      REQUIRE(check_mesh(mesh) == "");
      CHECK(mesh.faces[q.f].v == std::array<VertexId, 3>{q.a, q.b, q.d});
      CHECK(mesh.faces[q.g].v == std::array<VertexId, 3>{q.d, q.c, q.a});
    }
    CHECK(refused > 0);
    CHECK(mesh_topology(mesh).euler() == 2);
  }
}

TEST_CASE("flipping what is not convex ends in the convex hull") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    TriMesh mesh = octahedron();
    for (int n = 0; n < 60; ++n) {
      split_facet(mesh, FaceId(random.below(static_cast<std::uint32_t>(mesh.faces.size()))));
    }
    for (bool flipped = true; flipped;) {
      flipped = false;
      for (FaceId f = 0; f < mesh.faces.size(); ++f) {
        for (int i = 0; i < 3; ++i) {
          const Quad q = quad_at(mesh, f, i);
          if (!above(mesh, q.a, q.b, q.c, q.d) || has_diagonal(mesh, q)) continue;
          flip_edge(mesh, q);
          flipped = true;
        }
      }
    }
    CHECK(check_mesh(mesh) == "");
    for (const Face& face : mesh.faces) {
      for (VertexId v = 0; v < mesh.points.size(); ++v) {
        CHECK_FALSE(above(mesh, face.v[0], face.v[1], face.v[2], v));
      }
    }
  }
}

TEST_CASE("at the boundary the diagonal is looked for both ways round") {
  // A fan of three round vertex 0, open; 1 and 4 are not joined, 1 and 3 are not, 2 and 4 are not.
  TriMesh fan = make_tri_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}},
                              std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  const Quad q = quad_at(fan, 1, 2);  // the edge 0-2
  CHECK_FALSE(has_diagonal(fan, q));
  flip_edge(fan, q);
  CHECK(check_mesh(fan) == "");
}
