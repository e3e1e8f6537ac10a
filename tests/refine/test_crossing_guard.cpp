// SPDX-License-Identifier: MIT
// The guard against crossing facets: its answers against all pairs, and what Stage 2 makes of them.
#include <doctest/doctest.h>

#include "base/random.h"
#include "refine/crossing_guard.h"
#include "deliso/deliso.h"
#include "deliso/fields.h"
#include "embedding/self_intersections.h"
#include "embedding/triangle_pair.h"

using namespace deliso;

namespace {

Vec3 random_point(Random& random, double size) {
  return {size * random.uniform(), size * random.uniform(), size * random.uniform()};
}

std::vector<Triangle> triangles_of(const TriMesh& mesh) {
  std::vector<Triangle> triangles;
  for (const Face& face : mesh.faces) triangles.push_back(face.v);
  return triangles;
}

}  // namespace

TEST_CASE("in guarded voxels the guard answers what all pairs give") {
  const Volume volume = make_builtin_volume("builtin:sphere:16");
  std::size_t crossing = 0, free = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    // Small triangles without order, all within the box.
    TriMesh mesh;
    for (int t = 0; t < 60; ++t) {
      const Vec3 p = random_point(random, 6);
      const auto first = static_cast<VertexId>(mesh.points.size());
      for (int i = 0; i < 3; ++i) mesh.points.push_back(p + random_point(random, 1.5));
      mesh.faces.push_back({{first, first + 1, first + 2}, {kNoId, kNoId, kNoId}});
    }
    std::vector<std::uint64_t> all;
    for (std::uint64_t n = 0; n < 15 * 15 * 15; ++n) all.push_back(n);
    const std::size_t known = 30;
    const std::vector<Face> faces = mesh.faces;
    mesh.faces.resize(known);
    CrossingGuard guard(volume, mesh, all, seed % 2 == 0 ? 1 : 0.2);
    REQUIRE(guard.is_on());
    for (std::size_t t = known; t < faces.size(); ++t) {
      const std::vector<Triangle> created = {faces[t].v};
      const std::vector<FaceId> removed = {static_cast<FaceId>(random.below(20))};
      bool expected = false;
      for (FaceId f = 0; f < mesh.faces.size(); ++f) {
        if (f == removed[0]) continue;
        expected |= triangles_intersect(mesh.points, faces[t].v, mesh.faces[f].v);
      }
      CHECK(guard.would_cross(created, removed) == expected);
      ++(expected ? crossing : free);
      mesh.faces.push_back(faces[t]);
      guard.add(static_cast<FaceId>(mesh.faces.size() - 1));
    }
  }
  CHECK(crossing > 50);
  CHECK(free > 50);
}

TEST_CASE("a guard of no voxels lets everything pass") {
  const Volume volume = make_builtin_volume("builtin:sphere:16");
  TriMesh mesh;
  mesh.points = {{1, 1, 1}, {3, 1, 1}, {1, 3, 1}, {2, 2, 0}, {2, 2, 2}, {1, 1, 2}};
  mesh.faces.push_back({{0, 1, 2}, {kNoId, kNoId, kNoId}});
  CHECK_FALSE(CrossingGuard(volume, mesh, {}, 1).is_on());
  const std::vector<std::uint64_t> there = {
      voxel_number(volume.dims(), volume.voxel_at(mesh.points[0]))};
  const std::vector<Triangle> through = {{3, 4, 5}};
  CHECK(CrossingGuard(volume, mesh, there, 1).would_cross(through, {}));
  CHECK_FALSE(CrossingGuard(volume, mesh, {}, 1).would_cross(through, {}));
}

TEST_CASE("noise: what is left of crossing facets is what the report says, and turns help") {
  std::size_t with_turns = 0, without = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const Volume volume = make_builtin_volume("builtin:noise:" + std::to_string(15 + seed));
    for (const int turns : {1, 4}) {
      Options options;
      options.turns = turns;
      options.r_min = {0.1, true};
      Report report;
      const TriMesh mesh = mesh_isosurface(volume, 127.5, options, report);
      const std::vector<Triangle> triangles = triangles_of(mesh);
      const TriangleTree tree(mesh.points, triangles);
      CHECK(self_intersections(mesh.points, triangles, tree).size() == report.crossing_pairs);
      CHECK(report.turns >= 1);
      CHECK(report.turns <= static_cast<std::size_t>(turns));
      (turns == 1 ? without : with_turns) += report.troubled_facets + report.crossing_pairs;
    }
  }
  CHECK(with_turns < without);
}
