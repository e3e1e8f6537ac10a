// SPDX-License-Identifier: MIT
// A mesh cut into regions, and refined in them. Every region has the facets that it needs. The
// whole stays valid, and it is the same in any order of regions.
#include "refine/regions.h"

#include <doctest/doctest.h>

#include <numeric>
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

TEST_CASE("regions share no facet, have disjoint boxes, and all facets that reach into their box") {
  int cut = 0;
  for (int n = 0; n < kScenes; ++n) {
    CAPTURE(n);
    const Scene scene = some_scene(n);
    Stage stage(scene);
    const std::size_t most = 6 + 10 * static_cast<std::size_t>(n % 4);
    std::vector<std::uint32_t> near(stage.recovered.samples.size());
    std::iota(near.begin(), near.end(), 0);
    const double reach = 0.3 * (n % 3);
    std::vector<MeshRegion> parts =
        cut_into_regions(stage.surface_mesh, most, stage.recovered.samples, reach, near);
    if (parts.size() < 2) continue;
    ++cut;
    std::vector<int> part_of(stage.mesh.faces.size(), -1);
    std::vector<int> part_of_sample(stage.recovered.samples.size(), -1);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      MeshRegion& part = parts[k];
      extract(stage.surface_mesh, part);
      CHECK(part.facets.size() - part.box.first_free <= most);
      std::vector<FaceId> seen = part.facets;
      sort_unique(seen);
      for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) {
        const bool is_seen = std::binary_search(seen.begin(), seen.end(), f);
        CHECK(is_seen == reaches_into(part.box, stage.mesh, stage.mesh.faces[f].v));
      }
      for (std::size_t f = part.box.first_free; f < part.facets.size(); ++f) {
        CHECK(part_of[part.facets[f]] == -1);
        part_of[part.facets[f]] = static_cast<int>(k);
        const Face& whole = stage.mesh.faces[part.facets[f]];
        const Face& here = part.surface.mesh.faces[FaceId(f)];
        for (std::size_t i = 0; i < 3; ++i) {
          CHECK(part.vertices[here.v[i]] == whole.v[i]);
          CHECK(part.box.holds(stage.mesh.points[whole.v[i]]));
          CHECK_FALSE(stage.surface_mesh.chain.is_boundary(whole.v[i]));
          REQUIRE(here.n[i] != kNoId);
          CHECK(part.facets[here.n[i]] == whole.n[i]);
        }
      }
      for (const std::uint32_t m : part.samples) {
        CHECK(part_of_sample[m] == -1);
        part_of_sample[m] = static_cast<int>(k);
      }
    }
    std::size_t left = 0;
    for (std::uint32_t m = 0; m < part_of_sample.size(); ++m) {
      const auto at = std::ranges::find_if(parts, [&](const MeshRegion& part) {
        return part.box.holds(stage.recovered.samples[m], reach);
      });
      CHECK(part_of_sample[m] == (at == parts.end() ? -1 : static_cast<int>(at - parts.begin())));
      left += at == parts.end();
    }
    CHECK(left == near.size());
    const Stage::Snapshot before = stage.snapshot();
    for (const MeshRegion& part : parts) put_back(stage.surface_mesh, part);
    for (Face& face : stage.surface_mesh.mesh.faces) face.n = {kNoId, kNoId, kNoId};
    link_faces(stage.surface_mesh.mesh);
    CHECK(before == stage.snapshot());
  }
  CHECK(cut >= 20);
}

TEST_CASE("a mesh refined in regions stays valid, and is the same with any number of threads") {
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
      for (const OperationCounts& operation : stage.report.operations) {
        put_off += operation.refused[static_cast<std::size_t>(Refusal::frozen)];
      }
    }
  }
  MESSAGE(whole, " vertices, ", left_whole, " facets and points left; in parts ", in_parts, ", ",
          left_in_parts, "; put off ", put_off);
  CHECK(put_off > 1000);
  CHECK(static_cast<double>(in_parts) < 1.05 * static_cast<double>(whole));
  CHECK(static_cast<double>(left_in_parts) < 1.1 * static_cast<double>(left_whole));
}
