// SPDX-License-Identifier: MIT
// Patches triangulated anew: a mesh that was Delaunay, with edges flipped at random, comes back,
// and after every patch all holds that must.
#include "refine/retriangulate.h"

#include <doctest/doctest.h>

#include <set>

#include "refine/stage.h"

using namespace deliso;
using namespace deliso::test;

namespace {

Triangle rotated(Triangle v) {
  std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
  return v;
}

// Flips an edge of f and one of what that makes, and so on: a patch no single flip mends.
void spoil(Stage& stage, FaceId f, int flips, Random& random) {
  for (int n = 0; n < flips; ++n) {
    std::vector<FaceId> made;
    if (!stage.flip_anyway(f, static_cast<int>(random.below(3)), &made)) continue;
    f = made[random.below(2)];
  }
}

struct Result {
  std::size_t lost = 0;  // Delaunay facets that the flips took away
  std::size_t left = 0;  // facets that are not Delaunay in the end, and were at first
  int patches = 0;
};

Result scramble(const std::string& field, int size, int flips) {
  const Scene scene = builtin_scene(field, size);
  Options options;
  options.r_min = {0.25, Length::Unit::voxel};
  Stage stage(scene, options, true);
  Retriangulator retriangulator(stage.surface_mesh, stage.replacer, stage.report);
  // What it leaves is all that can be had.
  const auto mend = [&] {
    int patches = 0;
    for (bool any = true; any;) {
      any = false;
      for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) {
        if (is_dead(stage.mesh.faces[f]) || !retriangulator.retriangulate(f)) continue;
        any = true;
        REQUIRE(++patches < 10000);
      }
    }
    return patches;
  };
  mend();
  std::set<Triangle> before;
  for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) {
    if (!is_dead(stage.mesh.faces[f]) && stage.is_delaunay(f)) {
      before.insert(rotated(stage.mesh.faces[f].v));
    }
  }
  const auto missing = [&] {
    std::set<Triangle> now;
    for (const Face& face : stage.mesh.faces) now.insert(rotated(face.v));
    return static_cast<std::size_t>(std::count_if(
        before.begin(), before.end(), [&](const Triangle& t) { return !now.contains(t); }));
  };
  CHECK(missing() == 0);
  const auto not_delaunay = [&] {
    std::size_t count = 0;
    for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) {
      count += !is_dead(stage.mesh.faces[f]) && !stage.is_delaunay(f);
    }
    return count;
  };
  const std::size_t never = not_delaunay();
  Random random(7);
  const auto faces = static_cast<FaceId>(stage.mesh.faces.size());
  for (FaceId f = 0; f < faces; f += 50) {
    if (!is_dead(stage.mesh.faces[f])) spoil(stage, f, flips, random);
  }
  REQUIRE(stage.fault() == "");
  Result result;
  result.lost = missing();
  const std::size_t facets = stage.live_facets();
  result.patches = mend();
  // Not the facets that were there: of four vertices on one circle either diagonal will do.
  const std::size_t now = not_delaunay();
  result.left = now - std::min(now, never);
  CHECK(stage.fault() == "");
  CHECK(stage.live_facets() == facets);
  return result;
}

}  // namespace

TEST_CASE("patches spoilt by flips are Delaunay again") {
  struct Field {
    std::string name;
    int size;
  };
  for (const Field& field : {Field{"torus", 24}, Field{"sphere", 24}, Field{"linked_tori", 32}}) {
    for (const int flips : {1, 2, 4}) {
      CAPTURE(field.name);
      CAPTURE(flips);
      const Result result = scramble(field.name, field.size, flips);
      CHECK(result.lost > 15);
      CHECK(result.patches > 5);
      // Four flips in a row can fold a patch beyond what is taken for one.
      CHECK(result.left <= (flips < 4 ? 0 : result.lost / 4));
    }
  }
}

TEST_CASE("every new patch is Delaunay where the old one was not, and keeps the mesh what it is") {
  int done = 0, refused = 0, fine = 0;
  for (int n = 0; n < kScenes; ++n) {
    CAPTURE(n);
    const Scene scene = some_scene(n);
    Options options;
    options.r_min = {n % 2 == 0 ? 0.1 : 0.5, Length::Unit::voxel};
    Stage stage(scene, options);
    Retriangulator retriangulator(stage.surface_mesh, stage.replacer, stage.report);
    Random random(static_cast<std::uint64_t>(n) + 700);
    for (int k = 0; k < 200; ++k) {
      CAPTURE(k);
      const FaceId f = stage.random_facet(random);
      if (k % 2 == 0) spoil(stage, f, 1 + static_cast<int>(random.below(4)), random);
      if (is_dead(stage.mesh.faces[f])) continue;
      const Stage::Snapshot before = stage.snapshot();
      const bool delaunay = stage.is_delaunay(f);
      if (!retriangulator.retriangulate(f)) {
        REQUIRE(stage.snapshot() == before);
        ++(delaunay ? fine : refused);
        continue;
      }
      ++done;
      REQUIRE_FALSE(delaunay);
      REQUIRE(stage.fault() == "");
      REQUIRE(stage.fault_of(retriangulator.created()) == "");
      REQUIRE(stage.mesh.points.size() == before.points.size());
      REQUIRE(stage.mesh.faces.size() == before.faces.size());
      for (const FaceId g : retriangulator.created()) REQUIRE(stage.is_delaunay(g));
    }
  }
  MESSAGE(done << " patches, " << refused << " refused, " << fine << " Delaunay already");
  CHECK(done > 200);
  CHECK(refused > 50);
  CHECK(fine > 200);
}
