// SPDX-License-Identifier: MIT
// Collapses where Stage 1 left needles. test_storm.cpp has random ones.
#include "refine/operations.h"

#include <doctest/doctest.h>

#include "refine/stage.h"

using namespace deliso;
using namespace deliso::test;

// Stage 1's sites may lie very near each other. All over noise and plateaus, where they do:
TEST_CASE("needles of tiny volumes are collapsed, and none is left that could be") {
  int collapsed = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    CAPTURE(seed);
    const Scene scene = noise_scene(seed);
    Stage stage(scene);
    REQUIRE(stage.fault() == "");
    for (bool any = true; any;) {
      any = false;
      for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) {
        if (is_dead(stage.mesh.faces[f]) || collapse_short_edge(stage.r, f)) continue;
        any = true;
        ++collapsed;
        REQUIRE(stage.fault() == "");
      }
    }
  }
  MESSAGE(collapsed << " collapsed");
  CHECK(collapsed > 100);
}
