// SPDX-License-Identifier: MIT
// Moves the vertices of coarse meshes off Sigma. The mesh keeps its topology, its boundary and its
// embedding, stays within the bound, and is nearer to Sigma in the mean.
#include "cases.h"
#include "more/counts/free_vertices.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/triangle.h"
#include "check/distances.h"
#include "more/counts/merge_vertices.h"
#include "more/counts/orientation.h"
#include "refine/stage.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// The largest r/l of all facets.
double worst_ratio(const TriMesh& mesh) {
  double worst2 = 0;
  for (const Face& face : mesh.faces) {
    if (is_dead(face)) continue;
    const auto& [a, b, c] = face.v;
    worst2 = std::max(worst2, radius_ratio2(mesh.points[a], mesh.points[b], mesh.points[c]));
  }
  return std::sqrt(worst2);
}

double mean_distance(const Scene& scene, const TriMesh& mesh) {
  double sum = 0;
  for (const Vec3& p : scene.contour.points) sum += std::sqrt(distance2_to_mesh(p, mesh));
  return sum / static_cast<double>(scene.contour.points.size());
}

}  // namespace

TEST_CASE("free vertices keep topology, embedding, boundary and shapes, and their bound") {
  std::size_t moved = 0;
  for (int n = 0; n < test::cases(kScenes); ++n) {
    CAPTURE(n);
    const Scene scene = some_scene(n);
    if (scene.contour.points.empty()) continue;
    Stage stage(scene, {}, true);
    stage.r.parameters.refinement[Criterion::distance] = kNotAsked;
    const std::size_t count = used_vertices(stage.mesh) / (2 + n % 5);
    const bool in_rounds = n % 2 == 0;
    if (!in_rounds) merge_vertices(stage.r, count);
    const TriMesh before = stage.mesh;
    const double within = (n % 3 == 0 ? 0.02 : 0.5) * scene.volume.voxel();
    if (in_rounds) {
      merge_and_free(stage.r, count, std::numeric_limits<std::size_t>::max(), within);
    } else {
      free_vertices(stage.r, within);
      CHECK(worst_ratio(stage.mesh) <= worst_ratio(before) + 1e-9);
    }
    stage.allow_off_surface();
    REQUIRE(stage.fault() == "");
    const auto is_used = stage.mesh.used_vertices();
    for (VertexId v = 0; v < before.points.size(); ++v) {
      if (is_used[v] == 0 || stage.mesh.points[v] == before.points[v]) continue;
      ++moved;
      CHECK_FALSE(stage.r.s.chain.is_boundary(v));
      CHECK(distance_off_surface(stage.mesh.points[v], stage.r.surface, 0, 2 * within) <=
            1.000001 * within);
    }
  }
  CHECK(moved > 100);
}

// The facets of a mesh with all corners on a sphere lie inside it, as far as they are wide.
TEST_CASE("free vertices halve the mean distance of a coarse sphere") {
  const Scene scene = builtin_scene("sphere", 20);
  Stage stage(scene, {}, true);
  stage.r.parameters.refinement[Criterion::distance] = kNotAsked;
  merge_vertices(stage.r, 50);
  const double before = mean_distance(scene, stage.mesh);
  free_vertices(stage.r, scene.volume.voxel());
  stage.allow_off_surface();
  CHECK(stage.fault() == "");
  CHECK(mean_distance(scene, stage.mesh) < 0.5 * before);
}

TEST_CASE("merges and moves by turns leave a nearer mesh than moves after all merges") {
  double by_turns = 0, after = 0;
  for (const char* field : {"gyroid", "noise", "marschner_lobb", "fuel"}) {
    const Scene scene = builtin_scene(field, 24);
    for (const bool turns : {false, true}) {
      Stage stage(scene, {}, true);
      stage.r.parameters.refinement[Criterion::distance] = kNotAsked;
      constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
      const std::size_t count = used_vertices(stage.mesh) / 5;
      const double within = scene.volume.voxel();
      if (turns) {
        merge_and_free(stage.r, count, kAll, within);
      } else {
        merge_vertices(stage.r, count);
        free_vertices(stage.r, within);
      }
      (turns ? by_turns : after) += mean_distance(scene, stage.mesh) / within;
    }
  }
  CAPTURE(by_turns);
  CAPTURE(after);
  CHECK(by_turns < 0.95 * after);
}

TEST_CASE("vertices on the box stay, those beside them move") {
  const Scene scene = builtin_scene("gyroid", 16);
  Stage stage(scene, {}, true);
  stage.r.parameters.refinement[Criterion::distance] = kNotAsked;
  merge_vertices(stage.r, used_vertices(stage.mesh) / 3);
  const std::vector<Vec3> before(stage.mesh.points.begin(), stage.mesh.points.end());
  free_vertices(stage.r, scene.volume.voxel());
  std::size_t moved = 0, on_box = 0;
  for (VertexId v = 0; v < before.size(); ++v) {
    const bool is_on_box = stage.r.s.chain.is_boundary(v);
    on_box += is_on_box;
    moved += before[v] != stage.mesh.points[v];
    if (is_on_box) CHECK(before[v] == stage.mesh.points[v]);
  }
  CHECK(on_box > 10);
  CHECK(moved > 10);
}

// What lies in a plane is as near as can be.
TEST_CASE("vertices in a plane stay") {
  const Scene scene = slab_scene();
  Stage stage(scene, {}, true);
  stage.r.parameters.refinement[Criterion::distance] = kNotAsked;
  merge_vertices(stage.r, used_vertices(stage.mesh) / 4);
  const std::vector<Vec3> before(stage.mesh.points.begin(), stage.mesh.points.end());
  free_vertices(stage.r, 1);
  for (VertexId v = 0; v < before.size(); ++v) {
    CHECK(distance(before[v], stage.mesh.points[v]) < 1e-6);
  }
}

// Gates see new facets alone, which may have passed a small component as a whole.
TEST_CASE("a vertex does not move past a component") {
  const Scene scene = builtin_scene("five_spheres", 20);
  Stage stage(scene, {}, true);
  stage.r.parameters.refinement[Criterion::distance] = kNotAsked;
  merge_vertices(stage.r, 0);
  Orientation orientation(stage.r);
  const TriMesh& mesh = stage.mesh;
  std::size_t passed = 0, reversed = 0, asked = 0;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    if (is_dead(mesh.faces[f])) continue;
    const VertexId v = mesh.faces[f].v[0];
    const Cavity* cavity = stage.r.open(stage.r.star(f, v));
    REQUIRE(cavity);
    for (const Vec3& p : mesh.points) {
      // Three times as far as the others: all of these are swept over, if they lie that way.
      const Vec3 to = mesh.points[v] + 3 * (p - mesh.points[v]);
      ++asked;
      passed += orientation.passes_component(cavity->disk, v, to);
      reversed += orientation.reverses(cavity->facets, v, to);
    }
    CHECK_FALSE(orientation.passes_component(cavity->disk, v, mesh.points[v]));
    CHECK_FALSE(orientation.reverses(cavity->facets, v, mesh.points[v]));
  }
  CHECK(passed > 0);
  CHECK(reversed > 0);
  CHECK(passed + reversed < asked);
}
