// SPDX-License-Identifier: MIT
// Coarsens refined meshes of all kinds, down to the fewest vertices. The mesh keeps its topology,
// stays embedded, and its vertices stay on Sigma. The least error is removed first.
#include "refine/coarsen.h"

#include <doctest/doctest.h>

#include "base/triangle.h"
#include "refine/stage.h"

using namespace deliso;
using namespace deliso::test;

namespace {

std::size_t closed_components(const TriMesh& mesh) {
  std::size_t closed = 0;
  for (const auto& [euler, loops] : kinds_of(mesh)) closed += loops == 0;
  return closed;
}

}  // namespace

TEST_CASE("a coarsened mesh is embedded, of the same topology, and has the vertices asked for") {
  for (int n = 0; n < kScenes; ++n) {
    CAPTURE(n);
    const Scene scene = some_scene(n);
    if (scene.contour.points.empty()) continue;
    Stage stage(scene, {}, true);
    stage.r.parameters.refinement[Criterion::distance] = kNotAsked;
    const std::size_t first = used_vertices(stage.mesh);
    const std::size_t closed = closed_components(stage.mesh);
    for (const std::size_t target : {first / 2, first / 4, std::size_t{0}}) {
      CAPTURE(target);
      const std::size_t left = coarsen(stage.r, target);
      REQUIRE(stage.fault() == "");
      CHECK(left == used_vertices(stage.mesh));
      CHECK(left >= std::max(target, 4 * closed));
      if (n < 8 && target > 0) CHECK(left == target);
    }
  }
}

TEST_CASE("spheres are coarsened to tetrahedra") {
  for (const auto& [name, spheres] : {std::pair{"sphere", 1u}, std::pair{"five_spheres", 5u}}) {
    const Scene scene = builtin_scene(name, 20);
    Stage stage(scene, {}, true);
    stage.r.parameters.refinement[Criterion::distance] = kNotAsked;
    CHECK(coarsen(stage.r, 0) == 4 * spheres);
    CHECK(stage.fault() == "");
  }
}

// A slab between two planes that are no faces of voxels: no vertex within a plane is needed.
TEST_CASE("what lies in a plane goes first") {
  std::vector<float> samples;
  for (int n = 0; n < 12 * 12 * 12; ++n) {
    samples.push_back(4 - std::abs(static_cast<float>(n % 12) - 5.3f));
  }
  const Scene scene(Volume::from_samples({12, 12, 12}, {1, 1, 1}, samples), 0.7);
  Stage stage(scene, {}, true);
  stage.r.parameters.refinement[Criterion::distance] = kNotAsked;
  coarsen(stage.r, 0);
  CHECK(stage.fault() == "");
  CHECK(used_vertices(stage.mesh) <= 16);
  for (const Vec3& p : scene.contour.points) {
    double nearest = 1e9;
    for (const Face& face : stage.mesh.faces) {
      if (is_dead(face)) continue;
      nearest = std::min(nearest, distance2_to_triangle(p, stage.mesh.points[face.v[0]],
                                                        stage.mesh.points[face.v[1]],
                                                        stage.mesh.points[face.v[2]]));
    }
    REQUIRE(nearest < 1e-10);
  }
}
