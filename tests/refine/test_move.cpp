// SPDX-License-Identifier: MIT
// Vertices moved along Sigma. After its vertices were displaced, moves bring a mesh back within its
// limits, by a count over all facets and vertices. Each move keeps the mesh valid.
#include "refine/operations.h"

#include <doctest/doctest.h>

#include "refine/stage.h"
#include "surface/criteria.h"

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
  Proposal* proposal = stage.r.propose(stage.r.star(f, v));
  if (!proposal) return false;
  proposal->move(v, p);
  return !stage.r.replace();
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

// What a move may change: one vertex that is not on the boundary, and duals around it.
void check_moved(Stage& stage, const Stage::Snapshot& before) {
  REQUIRE(stage.fault() == "");
  REQUIRE(stage.fault_of(stage.r.created()) == "");
  REQUIRE(stage.mesh.points.size() == before.points.size());
  std::size_t moved = 0;
  VertexId v = kNoId;
  for (VertexId q = 0; q < before.points.size(); ++q) {
    if (stage.mesh.points[q] == before.points[q]) continue;
    ++moved;
    v = q;
  }
  REQUIRE(moved == 1);
  CHECK_FALSE(stage.surface_mesh.chain.is_boundary(v));
  CHECK(distance(stage.mesh.points[v], before.points[v]) < 2 * stage.parameters.r_min);
  for (FaceId f = 0; f < before.faces.size(); ++f) {
    REQUIRE(stage.mesh.faces[f].v == before.faces[f].v);
    REQUIRE(stage.mesh.faces[f].n == before.faces[f].n);
  }
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

TEST_CASE("every move keeps the mesh valid, on meshes of all kinds and after random insertions") {
  int moved = 0, kept = 0;
  for (int n = 0; n < kScenes; ++n) {
    CAPTURE(n);
    const Scene scene = some_scene(n);
    Options options;
    options.r_min = {n % 2 == 0 ? 0.3 : 1.0, Length::Unit::voxel};
    options.limits[Criterion::r_over_l].value = 1;
    options.limits[Criterion::distance] = {0.02, Length::Unit::voxel};
    Stage stage(scene, options);
    Random random(static_cast<std::uint64_t>(n) + 1100);
    for (int k = 0; k < 70; ++k) {
      CAPTURE(k);
      const FaceId f = stage.random_facet(random);
      if (random.below(4) == 0) {
        if (const auto p = stage.point_near(f, random))
          insert_point(stage.r, Operation::foot, f, *p);
        continue;
      }
      const Stage::Snapshot before = stage.snapshot();
      if (move_corner(stage.r, f)) {
        REQUIRE(stage.snapshot() == before);
        ++kept;
        continue;
      }
      ++moved;
      check_moved(stage, before);
    }
  }
  MESSAGE(moved << " moved, " << kept << " not");
  CHECK(moved > 200);
  CHECK(kept > 100);
}
