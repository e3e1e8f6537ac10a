// SPDX-License-Identifier: MIT
// A mesh cut into parts, and refined in them: every part sees what it must, and the whole stays
// what it was and comes out the same, whoever refines which part when.
#include "refine/regions.h"

#include <doctest/doctest.h>

#include <optional>

#include "base/sorted_list.h"
#include "refine/stage.h"

using namespace deliso;
using namespace deliso::test;

namespace {

bool reaches_into(const Region& box, const TriMesh& mesh, const Triangle& v) {
  for (int axis = 0; axis < 3; ++axis) {
    const double a = mesh.points[v[0]][axis], b = mesh.points[v[1]][axis],
                 c = mesh.points[v[2]][axis];
    if (std::max({a, b, c}) < box.lo[axis] || std::min({a, b, c}) >= box.hi[axis]) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("parts share no facet, lie in boxes that share no point, and see all that is there") {
  int cut = 0;
  for (int n = 0; n < kScenes; ++n) {
    CAPTURE(n);
    const Scene scene = some_scene(n);
    Stage stage(scene);
    const std::size_t most = 6 + 10 * static_cast<std::size_t>(n % 4);
    const Cut parts(stage.surface_mesh, most);
    if (parts.size() < 2) continue;
    ++cut;
    std::vector<int> part_of(stage.mesh.faces.size(), -1);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const MeshRegion part = parts.extract(stage.surface_mesh, k);
      CHECK(part.facets.size() - part.region.first_free <= most);
      std::vector<FaceId> seen = part.facets;
      sort_out(seen);
      for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) {
        const bool is_seen = std::binary_search(seen.begin(), seen.end(), f);
        CHECK(is_seen == reaches_into(part.region, stage.mesh, stage.mesh.faces[f].v));
      }
      for (FaceId f(part.region.first_free); f < part.facets.size(); ++f) {
        CHECK(part_of[part.facets[f]] == -1);
        part_of[part.facets[f]] = static_cast<int>(k);
        const Face& whole = stage.mesh.faces[part.facets[f]];
        const Face& here = part.surface.mesh.faces[f];
        for (std::size_t i = 0; i < 3; ++i) {
          CHECK(part.vertices[here.v[i]] == whole.v[i]);
          CHECK(part.region.holds(stage.mesh.points[whole.v[i]]));
          CHECK(parts.box_at(stage.mesh.points[whole.v[i]]) == k);
          CHECK_FALSE(stage.surface_mesh.chain.is_boundary(whole.v[i]));
          REQUIRE(here.n[i] != kNoId);
          CHECK(part.facets[here.n[i]] == whole.n[i]);
        }
      }
    }
    const Stage::Snapshot before = stage.snapshot();
    for (std::size_t k = 0; k < parts.size(); ++k) {
      put_back(stage.surface_mesh, parts.extract(stage.surface_mesh, k));
    }
    CHECK(before == stage.snapshot());
  }
  CHECK(cut >= 20);
}

TEST_CASE("a mesh refined in parts keeps what it is, and is the same with any number of threads") {
  std::size_t left_whole = 0, left_in_parts = 0, whole = 0, in_parts = 0, put_off = 0;
  for (int n = 0; n < kScenes; ++n) {
    CAPTURE(n);
    const Scene scene = some_scene(n);
    Stage once(scene);
    refine(once.surface_mesh, scene.surface, once.recovered.curves, once.recovered.samples,
           once.parameters, once.report);
    left_whole += once.report[Counter::unrefined_facets] + once.report[Counter::points_far];
    whole += once.mesh.points.size();
    std::optional<Stage::Snapshot> first;
    for (const int threads : {1, 2, 3, 8}) {
      Stage stage(scene);
      stage.parameters.threads = threads;
      refine(stage.surface_mesh, scene.surface, stage.recovered.curves, stage.recovered.samples,
             stage.parameters, stage.report, 30);
      if (first) {
        CHECK(*first == stage.snapshot());
        continue;
      }
      first = stage.snapshot();
      REQUIRE(stage.fault() == "");
      left_in_parts += stage.report[Counter::unrefined_facets] + stage.report[Counter::points_far];
      in_parts += stage.mesh.points.size();
      for (const RungCounts& rung : stage.report.rungs) {
        put_off += rung.refused[static_cast<std::size_t>(Refusal::frozen)];
      }
    }
  }
  MESSAGE(whole, " vertices, ", left_whole, " facets and points left; in parts ", in_parts, ", ",
          left_in_parts, "; put off ", put_off);
  CHECK(put_off > 1000);
  CHECK(static_cast<double>(in_parts) < 1.05 * static_cast<double>(whole));
  CHECK(static_cast<double>(left_in_parts) < 1.1 * static_cast<double>(left_whole));
}
