// SPDX-License-Identifier: MIT
// Vertices moved along Sigma. After its vertices were displaced, moves bring a mesh back within its
// limits, by a count over all facets and vertices. test_storm.cpp has random moves.
#include "refine/operations.h"

#include <doctest/doctest.h>

#include <numeric>
#include <utility>

#include "refine/stage.h"
#include "run/criteria.h"

using namespace deliso;
using namespace deliso::test;

namespace {

struct Wanting {
  std::size_t over_limits = 0, not_delaunay = 0;
};

Wanting count_wanting(const Stage& stage) {
  Wanting wanting;
  for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) {
    if (is_dead(stage.mesh.faces[f])) continue;
    const Dual& dual = stage.surface_mesh.duals[f];
    wanting.over_limits += stage.r.violation(stage.mesh.faces[f].v, dual) > 1;
    wanting.not_delaunay += !stage.is_delaunay(f);
  }
  return wanting;
}

// Moves v to p when every gate lets it pass, wanted or not.
bool push(Stage& stage, FaceId f, VertexId v, const Vec3& p) {
  const Cavity* cavity = stage.r.open(stage.r.star(f, v));
  return cavity && !stage.r.make(cavity->move(v, p, Gates{}));
}

// Along Sigma, as far as `far`.
std::optional<Vec3> beside(Stage& stage, VertexId v, double far, Random& random) {
  const Vec3& p = stage.mesh.points[v];
  const Vec3 gradient = stage.scene.surface.gradient(p);
  const Vec3 any{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  const Vec3 along = cross(gradient, any);
  if (!(length(along) > 0)) return std::nullopt;
  return stage.r.finder.foot(p + (far / length(along)) * along, -1 * gradient, far,
                             stage.report.searches_refine);
}

}  // namespace

TEST_CASE("moves make facets good again whose vertices were displaced along the surface") {
  for (const std::string name : {"linked_tori", "orbital"}) {
    CAPTURE(name);
    const Scene scene = builtin_scene(name, 20);
    Stage stage(scene, {}, true);
    const auto mend = [&] {
      int moves = 0;
      for (bool any = true; any;) {
        any = false;
        for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) {
          if (is_dead(stage.mesh.faces[f]) || move_corner(stage.r, f)) continue;
          any = true;
          REQUIRE(++moves < 10000);
        }
      }
      return moves;
    };
    mend();
    const Wanting always = count_wanting(stage);
    Random random(3);
    std::vector<FaceId> facet_of(stage.mesh.points.size(), kNoId);
    for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) {
      if (is_dead(stage.mesh.faces[f])) continue;
      for (const VertexId v : stage.mesh.faces[f].v) facet_of[v] = f;
    }
    for (VertexId v = 0; v < facet_of.size(); v = VertexId(v + 10)) {
      if (facet_of[v] == kNoId || stage.surface_mesh.chain.is_boundary(v)) continue;
      const auto p = beside(stage, v, 0.5 * stage.parameters.r_min, random);
      if (p) push(stage, facet_of[v], v, *p);
    }
    REQUIRE(stage.fault() == "");
    const Wanting before = count_wanting(stage);
    const int moves = mend();
    const Wanting after = count_wanting(stage);
    MESSAGE(name << ": " << before.over_limits << " + " << before.not_delaunay << " -> "
                 << after.over_limits << " + " << after.not_delaunay << ", " << moves
                 << " moves; at first " << always.over_limits << " + " << always.not_delaunay);
    CHECK(before.over_limits + before.not_delaunay > 20);
    CHECK(moves > 5);
    CHECK(4 * after.over_limits <= before.over_limits);
    CHECK(4 * after.not_delaunay <= before.not_delaunay);
    CHECK(stage.fault() == "");
  }
}

TEST_CASE("no vertex moves in a mesh without bad facets") {
  const Scene scene = builtin_scene("sphere", 16);
  Stage stage(scene, {}, true);
  REQUIRE(count_wanting(stage).over_limits + count_wanting(stage).not_delaunay == 0);
  const Stage::Snapshot before = stage.snapshot();
  for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) {
    if (!is_dead(stage.mesh.faces[f])) CHECK(move_corner(stage.r, f));
  }
  CHECK(stage.snapshot() == before);
}

TEST_CASE("a vertex that can move nowhere waits until a facet at it changes") {
  const Scene scene = builtin_scene("linked_tori", 20);
  Stage stage(scene, {}, true);
  OperationCounts& counts = stage.report[Operation::move];
  Random random(3);
  const auto displace = [&] {
    for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) {
      const VertexId v = stage.mesh.faces[f].v[0];
      const auto p = beside(stage, v, 0.5 * stage.parameters.r_min, random);
      if (p && !stage.surface_mesh.chain.is_boundary(v)) push(stage, f, v, *p);
    }
  };
  // Returns how many moves were done, and how many refused.
  const auto try_all = [&] {
    counts = {};
    for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) move_corner(stage.r, f);
    return std::pair(counts.done, std::reduce(counts.refused.begin(), counts.refused.end()));
  };
  for (int n = 0; n < 2; ++n) {
    displace();
    CHECK(try_all().second > 0);
    while (try_all().first > 0) continue;
    CHECK(try_all().second == 0);
  }
}
