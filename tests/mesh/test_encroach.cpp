// SPDX-License-Identifier: MIT
// Stage 2's insertion on the unit sphere. There the oracle is exact: the dual line of a facet
// passes the center, so its surface point is its unit normal, and the restricted Delaunay
// triangulation of points of the sphere is their convex hull.
#include "mesh/encroach.h"

#include <doctest/doctest.h>

#include <set>

#include "base/random.h"
#include "base/triangle.h"
#include "mesh/check_mesh.h"

using namespace deliso;

namespace {

Vec3 unit(const Vec3& v) {
  return v / length(v);
}

Vec3 facet_normal(const TriMesh& mesh, const Face& face) {
  return unit(area_normal(mesh.points[face.v[0]], mesh.points[face.v[1]], mesh.points[face.v[2]]));
}

TriMesh octahedron(Random& random) {
  std::vector<Vec3> points;
  for (const Vec3& p : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1},
                        Vec3{0, 0, -1}}) {
    const Vec3 shift{random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0};
    points.push_back(unit(p + shift));
  }
  const std::vector<Triangle> triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                           {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  TriMesh mesh = make_tri_mesh(points, triangles);
  for (const Face& face : mesh.faces) mesh.surface_points.push_back(facet_normal(mesh, face));
  return mesh;
}

// No vertex is above the plane of a facet by more than rounding explains.
bool is_convex_hull(const TriMesh& mesh) {
  for (const Face& face : mesh.faces) {
    const Vec3 n = facet_normal(mesh, face);
    const double height = dot(n, mesh.points[face.v[0]]);
    for (const Vec3& p : mesh.points) {
      if (dot(n, p) > height + 1e-12) return false;
    }
  }
  return true;
}

// Inserts p, encroaching upon `start`; false when the disk is refused.
bool insert_on_sphere(TriMesh& mesh, FaceId start, const Vec3& p) {
  std::vector<std::uint32_t> marks(mesh.faces.size(), 0);
  EncroachedDisk disk;
  if (!find_encroached_disk(mesh, start, p, marks, 1, disk)) return false;
  std::vector<Vec3> surface_points;
  for (const RimEdge& edge : disk.rim) {
    surface_points.push_back(unit(area_normal(mesh.points[edge.from], mesh.points[edge.to], p)));
  }
  std::vector<FaceId> created;
  replace_disk(mesh, disk, p, surface_points, std::nullopt, created);
  CHECK(std::set<FaceId>(created.begin(), created.end()).size() == disk.rim.size());
  return true;
}

}  // namespace

TEST_CASE("insertion on the sphere keeps the convex hull, a manifold of Euler number 2") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    TriMesh mesh = octahedron(random);
    int inserted = 0;
    while (inserted < 150) {
      const FaceId f = random.below(static_cast<std::uint32_t>(mesh.faces.size()));
      // The surface ball's center, or a point near it that is still in the ball.
      Vec3 p = mesh.surface_points[f];
      if (inserted % 2) {
        const Vec3& a = mesh.points[mesh.faces[f].v[0]];
        p = unit(p + 0.5 * random.uniform() * (a - p));
      }
      REQUIRE(is_encroached(mesh, f, p));
      REQUIRE(insert_on_sphere(mesh, f, p));
      ++inserted;
      REQUIRE(check_mesh(mesh) == "");
    }
    CHECK(mesh.faces.size() == 2 * mesh.points.size() - 4);
    CHECK(is_convex_hull(mesh));
  }
}

TEST_CASE("a disk that would swallow a vertex is refused") {
  Random random(7);
  TriMesh mesh = octahedron(random);
  // Balls so large that p encroaches upon every facet around vertex 4.
  for (FaceId f = 0; f < 4; ++f) mesh.surface_points[f] = {0, 0, 3};
  std::vector<std::uint32_t> marks(mesh.faces.size(), 0);
  EncroachedDisk disk;
  CHECK_FALSE(find_encroached_disk(mesh, 0, {0, 0, 2.9}, marks, 1, disk));
  CHECK(disk.faces.size() == 4);
}

TEST_CASE("a point on a boundary edge opens the cone there") {
  // A square of two facets in the plane z = 0; p splits the edge (0, 1).
  TriMesh mesh = make_tri_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                               std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  mesh.surface_points = {{0.5, 0.5, 0}, {0.5, 0.5, 0}};
  std::vector<std::uint32_t> marks(2, 0);
  EncroachedDisk disk;
  const Vec3 p{0.5, 0, 0};
  REQUIRE(find_encroached_disk(mesh, 0, p, marks, 1, disk));
  REQUIRE(disk.rim.size() == 4);
  std::optional<std::size_t> opened;
  for (std::size_t k = 0; k < disk.rim.size(); ++k) {
    if (disk.rim[k].from == 0 && disk.rim[k].to == 1) opened = k;
  }
  REQUIRE(opened.has_value());
  std::vector<FaceId> created;
  const VertexId v = replace_disk(mesh, disk, p, std::vector<Vec3>(4), opened, created);
  CHECK(mesh.faces.size() == 3);
  CHECK(check_mesh(mesh) == "");
  int boundary_at_v = 0;
  for (const Face& face : mesh.faces) {
    for (int i = 0; i < 3; ++i) {
      const bool at_v = face.v[(i + 1) % 3] == v || face.v[(i + 2) % 3] == v;
      if (face.n[i] == kNoId && at_v) ++boundary_at_v;
    }
  }
  CHECK(boundary_at_v == 2);
}
