// SPDX-License-Identifier: MIT
// Insertion on meshes of Stage 1, at points that refinement would choose and at random ones. The
// removed facets are the ones whose balls hold the point. The mesh stays valid after every
// insertion.
#include "refine/operations.h"

#include <doctest/doctest.h>

#include <set>

#include "deliso/deliso.h"
#include "io/volume/builtin_volume.h"
#include "refine/stage.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// The facets connected with `start` whose balls hold p, by going over all of them until none is
// new.
std::set<FaceId> encroached(const Stage& stage, FaceId start, const Vec3& p) {
  std::set<FaceId> disk{start};
  for (bool grown = true; grown;) {
    grown = false;
    for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) {
      const Face& face = stage.mesh.faces[f];
      if (is_dead(face) || disk.contains(f) || !stage.surface_mesh.duals[f].holds(p)) continue;
      for (const FaceId g : face.n) {
        if (g == kNoId || !disk.contains(g)) continue;
        disk.insert(f);
        grown = true;
        break;
      }
    }
  }
  return disk;
}

std::uint64_t done(const Report& report, Operation operation) {
  return report[operation].done;
}

// After a success: all that must hold, the new vertex in all new facets, nothing else touched.
void check_inserted(Stage& stage, const Stage::Snapshot& before, std::span<const FaceId> created) {
  REQUIRE(stage.fault() == "");
  REQUIRE(stage.fault_of(created) == "");
  REQUIRE(stage.mesh.points.size() == before.points.size() + 1);
  const auto v = VertexId(before.points.size());
  std::set<FaceId> is_new(created.begin(), created.end());
  REQUIRE(is_new.size() == created.size());
  for (const FaceId f : created) REQUIRE(has_corner(stage.mesh.faces[f].v, v));
  for (FaceId f = 0; f < before.faces.size(); ++f) {
    if (!is_new.contains(f)) REQUIRE(stage.mesh.faces[f].v == before.faces[f].v);
  }
}

struct InsertTally {
  int inserted = 0, refused = 0, splits = 0, splits_refused = 0;
  std::size_t refusals[kRefusals] = {};
};

// `tries` insertions and splits at random.
void insert_at_random(int n, int tries, const Options& options, InsertTally& tally) {
  CAPTURE(n);
  const Scene scene = some_scene(n);
  Stage stage(scene, options);
  REQUIRE(stage.fault() == "");
  Random random(static_cast<std::uint64_t>(n) + 100);
  const std::vector<Vec3>& witnesses = stage.recovered.samples;
  for (int k = 0; k < tries; ++k) {
    CAPTURE(k);
    const FaceId f = stage.random_facet(random);
    const Stage::Snapshot before = stage.snapshot();
    const std::uint64_t splits_before = done(stage.report, Operation::boundary_split);
    const std::uint32_t kind = random.below(8);
    if (kind == 0) {
      for (int i = 0; i < 3; ++i) {
        if (stage.mesh.faces[f].n[i] != kNoId) continue;
        if (!split_boundary_edge(stage.r, {f, i})) {
          ++tally.splits;
          check_inserted(stage, before, stage.r.created());
          CHECK(done(stage.report, Operation::boundary_split) == splits_before + 1);
        } else {
          ++tally.splits_refused;
          CHECK(stage.snapshot() == before);
        }
        break;
      }
      continue;
    }
    std::optional<Vec3> p;
    if (kind < 4 && stage.surface_mesh.duals[f].on_surface) p = stage.surface_mesh.duals[f].center;
    if (kind == 4 || kind == 5) p = stage.point_near(f, random);
    if (kind > 5) p = witnesses[random.below(static_cast<std::uint32_t>(witnesses.size()))];
    if (!p) continue;
    const std::set<FaceId> disk = encroached(stage, f, *p);
    const std::size_t facets = stage.live_facets();
    const auto refusal = insert_point(stage.r, Operation::foot, f, *p);
    if (refusal) {
      ++tally.refused;
      ++tally.refusals[static_cast<std::size_t>(*refusal)];
      REQUIRE(stage.snapshot() == before);
      continue;
    }
    ++tally.inserted;
    check_inserted(stage, before, stage.r.created());
    if (done(stage.report, Operation::boundary_split) > splits_before)
      continue;  // it split an edge
    REQUIRE(stage.mesh.points.back() == *p);
    REQUIRE(stage.live_facets() == facets + 2);
    for (const FaceId g : disk) {
      REQUIRE((is_dead(stage.mesh.faces[g]) || stage.mesh.faces[g].v != before.faces[g].v));
    }
  }
  CHECK(done(stage.report, Operation::foot) + done(stage.report, Operation::boundary_split) ==
        stage.report.insertions_refine);
  CHECK(stage.report.insertions_refine == stage.mesh.points.size() - stage.report.points_recovered);
}

}  // namespace

TEST_CASE("every insertion keeps the mesh valid; a refused one changes nothing") {
  InsertTally tally;
  Options options;
  options.r_min = {0.1, Length::Unit::voxel};
  for (int n = 0; n < kScenes; ++n) insert_at_random(n, 160, options, tally);
  MESSAGE(tally.inserted << " inserted, " << tally.refused << " refused, " << tally.splits
                         << " edges split, " << tally.splits_refused << " not");
  CHECK(tally.inserted > 800);
  CHECK(tally.refused > 200);
  CHECK(tally.splits > 20);
  CHECK(tally.refusals[static_cast<std::size_t>(Refusal::not_a_disk)] > 0);
  CHECK(tally.refusals[static_cast<std::size_t>(Refusal::crossing)] > 0);
  CHECK(tally.refusals[static_cast<std::size_t>(Refusal::no_surface_point)] > 0);
}

// With a large r_min the gates before the exact one let nearly everything pass.
TEST_CASE("insertions keep the mesh valid where no facet is large enough to need a surface point") {
  InsertTally tally;
  Options options;
  for (int n = 0; n < kScenes; ++n) {
    options.r_min = {n % 2 == 0 ? 0.6 : 3.0, Length::Unit::voxel};
    insert_at_random(n, 80, options, tally);
  }
  MESSAGE(tally.inserted << " inserted, " << tally.refused << " refused");
  CHECK(tally.inserted > 100);
  CHECK(tally.refusals[static_cast<std::size_t>(Refusal::too_close)] > 50);
}

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

TEST_CASE("every insertion of a run is counted once, as what was done") {
  const Volume volume = make_builtin_volume("builtin:gyroid");
  Report report;
  mesh_isosurface(volume, find_builtin_field("builtin:gyroid")->isovalue, {}, report);
  std::uint64_t inserted = 0;
  for (const Operation operation : {Operation::surface_point, Operation::foot,
                                    Operation::boundary_split, Operation::far_point}) {
    inserted += done(report, operation);
  }
  CHECK(done(report, Operation::boundary_split) > 0);
  CHECK(inserted == report.insertions_refine);
}
