// SPDX-License-Identifier: MIT
// Vertices that a coarser bound on the distance does not need are removed from meshes of Stage 2,
// also along the box. What remains is a valid mesh that keeps the criteria.
#include "refine/thin.h"

#include <doctest/doctest.h>

#include <limits>

#include "base/triangle.h"
#include "refine/operations.h"
#include "refine/stage.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// How much coarser the bound is for thinning than it was for Stage 2.
constexpr double kCoarser = 3;

struct ThinTally {
  int removed = 0, refused = 0, on_boundary = 0;
};

// The one vertex of the cavity that the new facets do not have.
VertexId removed_vertex(const Proposal& c) {
  VertexId gone = kNoId;
  for (const Triangle& was : c.was.facets) {
    for (const VertexId v : was) {
      const auto has_v = [&](const Triangle& t) { return has_corner(t, v); };
      if (v == gone || std::ranges::any_of(c.in.facets, has_v)) continue;
      REQUIRE(gone == kNoId);
      gone = v;
    }
  }
  REQUIRE(gone != kNoId);
  return gone;
}

void check_removed(Stage& stage, const Stage::Snapshot& before, ThinTally& tally) {
  REQUIRE(stage.fault() == "");
  REQUIRE(stage.fault_of(stage.r.created()) == "");
  REQUIRE(stage.mesh.points == before.points);  // vertices neither come nor move
  const VertexId gone = removed_vertex(stage.r.proposal);
  double nearest2 = std::numeric_limits<double>::infinity();
  for (const FaceId f : stage.r.created()) {
    CHECK(stage.surface_mesh.duals[f].on_surface);
    CHECK(violation(stage.r.shape(f), stage.r.parameters.refinement) <= 1);
    CHECK(stage.is_delaunay(f));
    nearest2 = std::min(nearest2, distance2_to_triangle(before.points[gone], stage.corner(f, 0),
                                                        stage.corner(f, 1), stage.corner(f, 2)));
  }
  const double limit = stage.r.parameters.refinement[Criterion::distance];
  CHECK(nearest2 <= limit * limit);
  const auto was_gone = [&](const auto& link) { return link.first == gone; };
  tally.on_boundary += std::ranges::any_of(before.links, was_gone);
}

std::vector<VertexId> all_vertices(const TriMesh& mesh) {
  std::vector<VertexId> all;
  for (VertexId v = 0; v < mesh.points.size(); ++v) all.push_back(v);
  return all;
}

}  // namespace

TEST_CASE(
    "every removal keeps the mesh valid and within the criteria; a refused one changes nothing") {
  ThinTally tally;
  for (int n = 0; n < kScenes; ++n) {
    CAPTURE(n);
    const Scene scene = some_scene(n);
    Stage stage(scene, {}, true);
    stage.r.parameters.refinement[Criterion::distance] *= kCoarser;
    const std::vector<VertexId> all = all_vertices(stage.mesh);
    int tries = 0;
    for (Thinning thinning(stage.r, all); thinning.has_next() && tries < 120; ++tries) {
      const Stage::Snapshot before = stage.snapshot();
      if (thinning.remove_next()) {
        REQUIRE(stage.snapshot() == before);
        ++tally.refused;
        continue;
      }
      ++tally.removed;
      check_removed(stage, before, tally);
    }
  }
  MESSAGE(tally.removed << " removed, " << tally.on_boundary << " of them on the box, "
                        << tally.refused << " refused");
  CHECK(tally.removed > 500);
  CHECK(tally.refused > 500);
  CHECK(tally.on_boundary > 20);
}

// Not none: a vertex that goes may leave the ball of a facet that is not beside it.
TEST_CASE("thinning ends when hardly a vertex can be removed") {
  for (const int n : {0, 1, 5, 8}) {
    CAPTURE(n);
    const Scene scene = some_scene(n);
    Stage stage(scene, {}, true);
    stage.r.parameters.refinement[Criterion::distance] *= kCoarser;
    const std::vector<VertexId> all = all_vertices(stage.mesh);
    const auto thin = [&] {
      std::size_t removed = 0;
      for (Thinning thinning(stage.r, all); thinning.has_next();)
        removed += !thinning.remove_next();
      return removed;
    };
    const std::size_t before = used_vertices(stage.mesh), removed = thin();
    CHECK(removed > before / 8);
    CHECK(used_vertices(stage.mesh) == before - removed);
    CHECK(stage.fault() == "");
    CHECK(20 * thin() < removed);
  }
}

TEST_CASE("only the vertices that were named are removed, and those inserted since") {
  const Scene scene = some_scene(1);
  Stage stage(scene, {}, true);
  stage.r.parameters.refinement[Criterion::distance] *= kCoarser;
  const std::vector<VertexId> few(all_vertices(stage.mesh));
  const std::span<const VertexId> named = std::span(few).first(few.size() / 4);
  const std::size_t before = stage.mesh.points.size();
  Random random(7);
  for (int k = 0; k < 40; ++k) {
    const FaceId f = stage.random_facet(random);
    if (const auto p = stage.point_near(f, random)) insert_point(stage.r, Operation::foot, f, *p);
  }
  std::size_t of_named = 0, of_inserted = 0;
  for (Thinning thinning(stage.r, named); thinning.has_next();) {
    if (thinning.remove_next()) continue;
    const VertexId gone = removed_vertex(stage.r.proposal);
    const bool is_named = std::ranges::find(named, gone) != named.end();
    REQUIRE((is_named || gone >= before));
    ++(is_named ? of_named : of_inserted);
  }
  CHECK(of_named > 0);
  CHECK(of_inserted > 0);
}
