// SPDX-License-Identifier: MIT
// Vertices that a coarser bound on the distance does not need are removed from meshes of Stage 2,
// also along the box. What remains is a valid mesh that keeps the criteria.
#include "refine/thin.h"

#include <doctest/doctest.h>

#include "refine/operations.h"
#include "refine/storm.h"

using namespace deliso;
using namespace deliso::test;

// Not none: a vertex that goes may leave the ball of a facet that is not beside it.
TEST_CASE("thinning ends when hardly a vertex can be removed") {
  for (const int n : {0, 1, 5, 8}) {
    CAPTURE(n);
    const Scene scene = some_scene(n);
    Stage stage(scene, {}, true);
    allow_coarser(stage);
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
  allow_coarser(stage);
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
    const VertexId gone = removed_vertex(stage.r.tried());
    const bool is_named = std::ranges::find(named, gone) != named.end();
    REQUIRE((is_named || gone >= before));
    ++(is_named ? of_named : of_inserted);
  }
  CHECK(of_named > 0);
  CHECK(of_inserted > 0);
}
