// SPDX-License-Identifier: MIT
// Flips by surface balls come to an end, and mend what flips have spoilt. test_storm.cpp has random
// ones.
#include "refine/operations.h"

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

std::set<Triangle> facets_of(const TriMesh& mesh) {
  std::set<Triangle> facets;
  for (const Face& face : mesh.faces) {
    if (!is_dead(face)) facets.insert(rotated(face.v));
  }
  return facets;
}

// Until no edge can be flipped; how many flips that took.
int flip_all(Stage& stage) {
  int flips = 0;
  for (bool any = true; any;) {
    any = false;
    for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) {
      for (int i = 0; i < 3; ++i) {
        if (is_dead(stage.mesh.faces[f]) || flip_if_not_delaunay(stage.r, f, i)) continue;
        any = true;
        REQUIRE(++flips < 100000);
      }
    }
  }
  return flips;
}

}  // namespace

TEST_CASE("flips come to an end, and an edge of a Delaunay mesh that was flipped is flipped back") {
  for (const std::string name : {"sphere", "torus", "linked_tori", "gyroid"}) {
    CAPTURE(name);
    const Scene scene = builtin_scene(name, 20);
    Stage stage(scene, {}, true);
    flip_all(stage);
    std::set<Triangle> before = facets_of(stage.mesh);
    Random random(7);
    // One flip here and there: far enough from each other that none sees another.
    std::vector<std::uint8_t> taken(stage.mesh.points.size(), 0);
    std::size_t spoilt = 0;
    for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) {
      const int i = static_cast<int>(random.below(3));
      const Face face = stage.mesh.faces[f];
      if (is_dead(face) || face.n[i] == kNoId) continue;
      const Corners4 q = corners_at(stage.mesh.faces, f, i);
      if (!stage.is_delaunay(f) || !stage.is_delaunay(q.g)) continue;
      if (taken[q.a] || taken[q.b] || taken[q.c] || taken[q.d]) continue;
      std::vector<FaceId> made;
      if (!stage.flip_anyway(f, i, &made)) continue;
      taken[q.a] = taken[q.b] = taken[q.c] = taken[q.d] = 1;
      if (stage.is_delaunay(made[0]) && stage.is_delaunay(made[1])) {
        // Four vertices on one circle: either diagonal will do.
        for (const Triangle& t : {Triangle{q.a, q.b, q.c}, Triangle{q.d, q.c, q.b}}) {
          before.erase(rotated(t));
        }
        for (const FaceId g : made) before.insert(rotated(stage.mesh.faces[g].v));
        continue;
      }
      ++spoilt;
    }
    REQUIRE(stage.fault() == "");
    CHECK(spoilt > 20);
    const std::set<Triangle> between = facets_of(stage.mesh);
    CHECK(between != before);
    const int flips = flip_all(stage);
    CHECK(flips >= static_cast<int>(spoilt));
    CHECK(facets_of(stage.mesh) == before);
    REQUIRE(stage.fault() == "");
  }
}
