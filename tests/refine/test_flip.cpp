// SPDX-License-Identifier: MIT
// Flips by surface balls: of meshes of Stage 1, of meshes spoilt by other flips, of any edge. A
// flip lowers the radii and leaves no corner in the other's ball. A spoilt edge is flipped back.
#include "refine/operations.h"

#include <doctest/doctest.h>

#include <set>

#include "refine/stage.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// Corners of the two facets at an edge: the edge from b to c as f runs, a of f, d beyond.
struct Corners4 {
  FaceId g;
  VertexId a, b, c, d;
};

Corners4 corners_at(const TriMesh& mesh, FaceId f, int i) {
  const FaceId g = mesh.faces[f].n[i];
  const Triangle& v = mesh.faces[f].v;
  return {g, v[i], v[(i + 1) % 3], v[(i + 2) % 3],
          mesh.faces[g].v[neighbor_index(mesh.faces[g], f)]};
}

struct FlipTally {
  int flipped = 0, refused = 0, delaunay = 0;
};

void flip_once(Stage& stage, FaceId f, int i, FlipTally& tally) {
  const Stage::Snapshot before = stage.snapshot();
  if (stage.mesh.faces[f].n[i] == kNoId) {
    CHECK(flip_if_not_delaunay(stage.r, f, i));
    CHECK(stage.snapshot() == before);
    return;
  }
  const Corners4 q = corners_at(stage.mesh, f, i);
  const Dual at_f = stage.surface_mesh.duals[f], at_g = stage.surface_mesh.duals[q.g];
  const bool wanted = at_f.holds(stage.mesh.points[q.d]) || at_g.holds(stage.mesh.points[q.a]);
  if (flip_if_not_delaunay(stage.r, f, i)) {
    REQUIRE(stage.snapshot() == before);
    ++(wanted ? tally.refused : tally.delaunay);
    return;
  }
  ++tally.flipped;
  REQUIRE(wanted);
  REQUIRE(stage.fault() == "");
  REQUIRE(stage.fault_of(stage.r.created()) == "");
  REQUIRE(stage.r.created().size() == 2);
  REQUIRE(stage.mesh.points.size() == before.points.size());
  double radii = 0;
  for (const FaceId g : stage.r.created()) {
    const Dual& dual = stage.surface_mesh.duals[g];
    const Triangle& v = stage.mesh.faces[g].v;
    CHECK(dual.on_surface);
    CHECK(has_corner(v, q.a));
    CHECK(has_corner(v, q.d));
    for (const VertexId other : {q.a, q.b, q.c, q.d}) {
      if (!has_corner(v, other)) CHECK_FALSE(dual.holds(stage.mesh.points[other]));
    }
    radii += std::sqrt(dual.radius2);
  }
  CHECK(radii < std::sqrt(at_f.radius2) + std::sqrt(at_g.radius2));
}

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

TEST_CASE(
    "only edges that are not Delaunay are flipped; flips lower the radii, the mesh stays valid") {
  FlipTally tally;
  for (int n = 0; n < kScenes; ++n) {
    CAPTURE(n);
    const Scene scene = some_scene(n);
    Options options;
    options.r_min = {0.1, Length::Unit::voxel};
    Stage stage(scene, options);
    Random random(static_cast<std::uint64_t>(n) + 500);
    for (int k = 0; k < 150; ++k) {
      CAPTURE(k);
      // New vertices and flips that nobody wants give it work.
      const FaceId f = stage.random_facet(random);
      const int i = static_cast<int>(random.below(3));
      std::vector<FaceId> made;
      if (random.below(3) == 0) {
        if (const auto p = stage.point_near(f, random))
          insert_point(stage.r, Operation::foot, f, *p);
      } else if (stage.flip_anyway(f, i, &made)) {
        REQUIRE(stage.fault() == "");
        for (const FaceId g : made) {
          for (int e = 0; e < 3; ++e) {
            if (!is_dead(stage.mesh.faces[g])) flip_once(stage, g, e, tally);
          }
        }
      }
      flip_once(stage, stage.random_facet(random), i, tally);
    }
    CHECK(stage.fault() == "");
    const auto& counts = stage.report[Operation::flip];
    std::uint64_t all = counts.done;
    for (const std::uint64_t c : counts.refused) all += c;
    CHECK(all > 0);
  }
  MESSAGE(tally.flipped << " flipped, " << tally.refused << " refused, " << tally.delaunay
                        << " not called for");
  CHECK(tally.flipped > 500);
  CHECK(tally.refused > 100);
  CHECK(tally.delaunay > 500);
}

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
      const Corners4 q = corners_at(stage.mesh, f, i);
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
