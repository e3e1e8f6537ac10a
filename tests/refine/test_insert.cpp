// SPDX-License-Identifier: MIT
// Insertions that are refused, and their counts. test_storm.cpp has random ones.
#include "refine/operations.h"

#include <doctest/doctest.h>

#include "deliso/mesh_isosurface.h"
#include "io/volume/builtin_volume.h"
#include "more/counts/unrefined.h"
#include "refine/stage.h"

using namespace deliso;
using namespace deliso::test;

TEST_CASE("a point too near a vertex is refused, and one whose cavity has a vertex inside") {
  const Scene scene = builtin_scene("sphere", 16);
  Options options;
  options.r_min = {1, Length::Unit::voxel};
  Stage stage(scene, options);
  const Vec3 at = stage.corner(0, 0);
  const Stage::Snapshot before = stage.snapshot();
  CHECK(insert_point(stage.r, Operation::foot, 0, at) == Refusal::too_close);
  CHECK(stage.snapshot() == before);
  // Balls so large that p encroaches upon every facet around a vertex.
  std::vector<FaceId> star;
  facets_around(stage.mesh, 0, stage.mesh.faces[0].v[0], star);
  const Vec3 out = at + 5 * (at - Vec3{7.5, 7.5, 7.5});
  for (const FaceId f : star) stage.surface_mesh.duals[f] = {out, 1e6, true};
  const Vec3 p = stage.surface_mesh.duals[0].center;
  CHECK(insert_point(stage.r, Operation::foot, 0, p) == Refusal::swallows_vertex);
  CHECK(stage.mesh.points.size() == before.points.size());
}

TEST_CASE("no point in the diametral ball of a boundary edge is inserted: the edge is split") {
  int tried = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    const Scene scene = wave_scene(seed, 9);
    Stage stage(scene);
    for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) {
      for (int i = 0; i < 3; ++i) {
        if (is_dead(stage.mesh.faces[f]) || stage.mesh.faces[f].n[i] != kNoId) continue;
        const Vec3 apex = stage.corner(f, i), a = stage.corner(f, (i + 1) % 3),
                   b = stage.corner(f, (i + 2) % 3);
        const Vec3 inside = 0.5 * (a + b) + 0.1 * distance(a, b) * ((apex - a) / distance(apex, a));
        const auto p = stage.r.finder.foot(inside, stage.normal(f), distance(a, b),
                                           stage.report.searches_refine);
        if (!p || distance(*p, 0.5 * (a + b)) >= 0.49 * distance(a, b)) continue;
        ++tried;
        const OperationCounts before = stage.report[Operation::foot];
        insert_point(stage.r, Operation::foot, f, *p);
        // Whether the split was done or refused, it was no insertion.
        REQUIRE(std::ranges::find(stage.mesh.points, *p) == stage.mesh.points.end());
        REQUIRE(stage.report[Operation::foot].done == before.done);
      }
    }
  }
  CHECK(tried > 50);
}

TEST_CASE("Stage 2 leaves no facet of a smooth surface that violates a criterion") {
  for (const char* name : {"sphere", "torus"}) {
    CAPTURE(name);
    const Scene scene = builtin_scene(name, 16);
    // Of a smaller radius Stage 1 knows nothing: many facets are too large then.
    for (const double radius : {Options::kNone, 0.8}) {
      Options options;
      options.limits[Criterion::radius].value = radius;
      Stage stage(scene, options, true);
      REQUIRE(stage.live_facets() > 100);
      CHECK((stage.report[Operation::surface_point].done > 100) == (radius < 1));
      count_unrefined(stage.surface_mesh, stage.parameters, stage.report);
      CHECK(stage.report[Counter::unrefined_facets] == 0);
    }
  }
}

TEST_CASE("every insertion of a run is counted once, as what was done") {
  const Volume volume = make_builtin_volume("builtin:gyroid");
  Report report;
  mesh_isosurface(volume, find_builtin_field("builtin:gyroid")->isovalue, {}, report);
  std::uint64_t inserted = 0;
  for (const Operation operation : {Operation::surface_point, Operation::foot,
                                    Operation::boundary_split, Operation::far_point}) {
    inserted += report[operation].done;
  }
  CHECK(report[Operation::boundary_split].done > 0);
  CHECK(inserted == report.insertions_refine);
}
