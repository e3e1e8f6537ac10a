// SPDX-License-Identifier: MIT
// Coarsens refined meshes of all kinds, down to the fewest vertices. The mesh keeps its topology,
// stays embedded, and its vertices stay on Sigma. The least error is removed first.
#include "cases.h"
#include "more/counts/merge_vertices.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <map>

#include "base/triangle.h"
#include "refine/stage.h"
#include "stress/tiny_volume.h"

using namespace deliso;
using namespace deliso::test;

namespace {

std::size_t closed_components(const TriMesh& mesh) {
  std::size_t closed = 0;
  for (const auto& [euler, loops] : kinds_of(mesh)) closed += loops == 0;
  return closed;
}

// Per vertex the sign of what its component bounds: a volume if it is closed, an area if its
// boundary loops lie within faces of the box; components that pass an edge of the box are left out.
using Signs = std::map<VertexId, bool>;
Signs signs_of(const TriMesh& mesh, const Box3& box) {
  Signs signs;
  std::vector<std::uint8_t> seen(mesh.faces.size(), 0);
  for (FaceId start = 0; start < mesh.faces.size(); ++start) {
    if (seen[start] || is_dead(mesh.faces[start])) continue;
    std::vector<FaceId> component{start};
    seen[start] = 1;
    double volume = 0, area = 0;
    bool is_closed = true, passes_edge = false;
    const Vec3 origin = mesh.points[mesh.faces[start].v[0]];
    for (std::size_t k = 0; k < component.size(); ++k) {
      const Face& face = mesh.faces[component[k]];
      const auto at = [&](int i) { return mesh.points[face.v[i % 3]]; };
      volume += dot(at(0) - origin, cross(at(1) - origin, at(2) - origin));
      for (int i = 0; i < 3; ++i) {
        const FaceId g = face.n[i];
        if (g == kNoId) {
          is_closed = false;
          const Vec3 a = at(i + 1), b = at(i + 2);
          const unsigned of_a = box_faces_at(a, box), of_b = box_faces_at(b, box);
          passes_edge |= std::popcount(of_a) != 1 || of_a != of_b;
          const int axis = std::countr_zero(of_a & of_b) / 2;
          // Loops on opposite faces run opposite ways.
          area += ((of_a & of_b & 0x15) != 0 ? 1 : -1) * cross(a - origin, b - origin)[axis];
        } else if (!seen[g]) {
          seen[g] = 1;
          component.push_back(g);
        }
      }
    }
    if (passes_edge) continue;
    for (const FaceId f : component) {
      for (const VertexId v : mesh.faces[f].v) signs[v] = (is_closed ? volume : area) > 0;
    }
  }
  return signs;
}

// Calls test(n, stage) for some volumes of all kinds, refined and without a bound on the distance.
template <class Test>
void for_each_scene(Test&& test) {
  for (int n = 0; n < test::cases(kScenes); ++n) {
    CAPTURE(n);
    const Scene scene = some_scene(n);
    if (scene.contour.points.empty()) continue;
    Stage stage(scene, {}, true);
    stage.r.parameters.refinement[Criterion::distance] = kNotAsked;
    test(n, stage);
  }
}

}  // namespace

TEST_CASE("a coarsened mesh is embedded, of the same topology, and has the vertices asked for") {
  for_each_scene([](int n, Stage& stage) {
    const std::size_t first = used_vertices(stage.mesh);
    const std::size_t closed = closed_components(stage.mesh);
    for (const std::size_t target : {first / 2, first / 4, std::size_t{0}}) {
      CAPTURE(target);
      const std::size_t left = merge_vertices(stage.r, target);
      REQUIRE(stage.fault() == "");
      CHECK(left == used_vertices(stage.mesh));
      CHECK(left >= std::max(target, 4 * closed));
      if (n < 8 && target > 0) CHECK(left == target);
    }
  });
}

// The volume of closed components and the areas of loops within a face of the box keep their signs.
// A component whose boundary passes an edge of the box keeps its vertices there, and so its side.
TEST_CASE("no component is reversed, however few vertices are left") {
  std::size_t signs = 0;
  for (std::uint64_t seed = 160; seed < 160 + test::cases(100u); ++seed) {
    CAPTURE(seed);
    const stress::TinyVolume tiny = stress::make_tiny_volume(seed);
    const Scene scene(tiny.volume, geometric_isovalue(tiny.volume.type(), tiny.isovalue));
    if (scene.contour.points.empty()) continue;
    Stage stage(scene, {}, true);
    stage.r.parameters.refinement[Criterion::distance] = kNotAsked;
    const Signs before = signs_of(stage.mesh, scene.volume.box());
    merge_vertices(stage.r, 0);
    const Signs after = signs_of(stage.mesh, scene.volume.box());
    for (const auto& [vertex, sign] : after) {
      const auto was = before.find(vertex);
      REQUIRE(was != before.end());
      CHECK(was->second == sign);
      ++signs;
    }
  }
  CHECK(signs > test::cases(5000u));
}

// Merges into one component leave the costs of merges into the others as they were. Otherwise a
// pass would end at its first merge, as all other costs had risen above it.
TEST_CASE("specks that are all alike are coarsened in as few tries as other meshes") {
  constexpr int kSide = 8, kStride = 3, kSpecks = kSide * kSide * kSide;
  std::vector<float> samples;
  constexpr int kSamples = kSide * kStride;
  for (int n = 0; n < kSamples * kSamples * kSamples; ++n) {
    const auto is_speck = [](int i) { return i % kStride == 1; };
    const bool is_inside = is_speck(n % kSamples) && is_speck(n / kSamples % kSamples) &&
                           is_speck(n / (kSamples * kSamples));
    samples.push_back(is_inside ? 1 : 0);
  }
  const Scene scene(
      Volume::from_samples({kSamples, kSamples, kSamples}, {1, 1, 1}, std::move(samples)), 0.5);
  Stage stage(scene, {}, true);
  struct Tries : Observer {
    void steps_done(std::size_t done, std::size_t) override { tries = done; }
    std::size_t tries = 0;
  } observer;
  stage.r.parameters.refinement[Criterion::distance] = kNotAsked;
  stage.r.parameters.observer = &observer;
  const std::size_t first = used_vertices(stage.mesh);
  REQUIRE(first >= 6 * kSpecks);
  merge_vertices(stage.r, 5 * kSpecks);
  CHECK(observer.tries > 0);
  CHECK(observer.tries < 20 * first);
}

TEST_CASE("spheres are coarsened to tetrahedra") {
  for (const auto& [name, spheres] : {std::pair{"sphere", 1u}, std::pair{"five_spheres", 5u}}) {
    const Scene scene = builtin_scene(name, 20);
    Stage stage(scene, {}, true);
    stage.r.parameters.refinement[Criterion::distance] = kNotAsked;
    CHECK(merge_vertices(stage.r, 0) == 4 * spheres);
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
  merge_vertices(stage.r, 0);
  CHECK(stage.fault() == "");
  CHECK(used_vertices(stage.mesh) <= 16);
  for (const Vec3& p : scene.contour.points) REQUIRE(distance2_to_mesh(p, stage.mesh) < 1e-10);
}

// Gate G4 refuses merges that leave a vertex too far behind. Such a refusal once meant "costs more
// than was known" to the loop, which tried the same merge for ever.
TEST_CASE("coarsening with a bound on the distance ends, at a mesh that is finer than without it") {
  const Scene scene = builtin_scene("fuel", 16);
  const auto left = [&](double bound) {
    Stage stage(scene, {}, true);
    stage.r.parameters.refinement[Criterion::distance] = bound;
    const std::size_t vertices = merge_vertices(stage.r, 0);
    CHECK(stage.fault() == "");
    CHECK((stage.report[Operation::collapse].refused[static_cast<std::size_t>(Refusal::uncovers)] >
           0) == std::isfinite(bound));
    return vertices;
  };
  const std::size_t with_no_bound = left(kNotAsked);
  CHECK(left(0.2) > with_no_bound);
}

TEST_CASE("the furthest sample is as far as the nearest of all facets") {
  for (const int n : {0, 2, 5, 9, 17}) {
    CAPTURE(n);
    const Scene scene = some_scene(n);
    Stage stage(scene, {}, true);
    stage.r.parameters.refinement[Criterion::distance] = kNotAsked;
    merge_vertices(stage.r, used_vertices(stage.mesh) / 2);
    double furthest2 = 0;
    for (const Vec3& p : scene.contour.points) {
      furthest2 = std::max(furthest2, distance2_to_mesh(p, stage.mesh));
    }
    CHECK(furthest_distance(stage.mesh, stage.r.facets(), scene.contour.points,
                            scene.volume.voxel()) == std::sqrt(furthest2));
  }
}
