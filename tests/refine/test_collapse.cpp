// SPDX-License-Identifier: MIT
// Collapses on meshes of Stage 1, with criteria so strict that nearly every facet needs one. A
// collapse removes one vertex and keeps the mesh valid, also along the box.
#include "refine/operations.h"

#include <doctest/doctest.h>

#include <limits>

#include "base/triangle.h"
#include "refine/stage.h"

using namespace deliso;
using namespace deliso::test;

namespace {

double ratio(const Stage& stage, FaceId f) {
  const Vec3 &a = stage.corner(f, 0), &b = stage.corner(f, 1), &c = stage.corner(f, 2);
  return distance(circumcenter(a, b, c), a) / std::sqrt(shortest_edge2(a, b, c));
}

double shortest_edge(const Stage& stage, FaceId f) {
  return std::sqrt(shortest_edge2(stage.corner(f, 0), stage.corner(f, 1), stage.corner(f, 2)));
}

std::size_t boundary_vertices(const Stage& stage) {
  std::size_t n = 0;
  for (VertexId v = 0; v < stage.mesh.points.size(); ++v) {
    n += stage.surface_mesh.chain.is_boundary(v);
  }
  return n;
}

struct CollapseTally {
  int collapsed = 0, refused = 0, on_boundary = 0;
};

// The vertex that is gone, and what must hold then.
void check_collapsed(Stage& stage, const Stage::Snapshot& before, std::size_t vertices,
                     std::size_t on_boundary, std::span<const FaceId> created,
                     CollapseTally& tally) {
  REQUIRE(stage.fault() == "");
  REQUIRE(stage.fault_of(created) == "");
  REQUIRE(used_vertices(stage.mesh) == vertices - 1);
  REQUIRE(stage.mesh.points == before.points);  // vertices neither come nor move
  tally.on_boundary += boundary_vertices(stage) < on_boundary;
}

// The vertex that went lies near the facets that replaced it (G4).
void check_covered(const Stage& stage, const Stage::Snapshot& before) {
  const double limit = 2 * stage.parameters.refinement[Criterion::distance];
  for (const Triangle& t : stage.r.proposal.was.facets) {
    for (const VertexId v : t) {
      double nearest2 = std::numeric_limits<double>::infinity();
      for (const FaceId g : stage.r.created()) {
        nearest2 =
            std::min(nearest2, distance2_to_triangle(before.points[v], stage.corner(g, 0),
                                                     stage.corner(g, 1), stage.corner(g, 2)));
      }
      CHECK(nearest2 <= limit * limit);
    }
  }
}

void collapse_at_random(int n, double lambda, double r_min, CollapseTally& tally) {
  CAPTURE(n);
  CAPTURE(lambda);
  const Scene scene = some_scene(n);
  Options options;
  options.r_min = {r_min, Length::Unit::voxel};
  options.limits[Criterion::r_over_l].value = lambda;
  Stage stage(scene, options);
  const std::size_t of_stage1 = stage.mesh.points.size();
  Random random(static_cast<std::uint64_t>(n) + 900);
  for (int k = 0; k < 60; ++k) {
    CAPTURE(k);
    const FaceId f = stage.random_facet(random);
    if (random.below(8) == 0) {  // vertices of Stage 2, which must stay
      if (const auto p = stage.point_near(f, random)) insert_point(stage.r, Operation::foot, f, *p);
      continue;
    }
    const Stage::Snapshot before = stage.snapshot();
    const std::size_t vertices = used_vertices(stage.mesh), on_boundary = boundary_vertices(stage);
    const bool asked = ratio(stage, f) > stage.parameters.refinement[Criterion::r_over_l] &&
                       shortest_edge(stage, f) < stage.parameters.r_min;
    double worst_before = 0;
    for (FaceId g = 0; g < stage.mesh.faces.size(); ++g) {
      if (!is_dead(stage.mesh.faces[g])) worst_before = std::max(worst_before, ratio(stage, g));
    }
    if (collapse_short_edge(stage.r, f)) {
      REQUIRE(stage.snapshot() == before);
      ++tally.refused;
      continue;
    }
    REQUIRE(asked);
    ++tally.collapsed;
    check_collapsed(stage, before, vertices, on_boundary, stage.r.created(), tally);
    for (const FaceId g : stage.r.created()) CHECK(ratio(stage, g) <= 2.0001 * worst_before);
    check_covered(stage, before);
    // Vertices that insertion made are still there.
    std::vector<std::uint8_t> used(stage.mesh.points.size(), 0);
    for (const Face& face : stage.mesh.faces) {
      if (is_dead(face)) continue;
      for (const VertexId v : face.v) used[v] = 1;
    }
    for (std::size_t v = of_stage1; v < used.size(); ++v) REQUIRE(used[v]);
  }
}

}  // namespace

TEST_CASE("every collapse removes one vertex of Stage 1 and keeps the mesh valid") {
  CollapseTally tally;
  for (int n = 0; n < kScenes; ++n) {
    collapse_at_random(n, 0.6, 3, tally);
    collapse_at_random(n, 1.2, 1, tally);
    collapse_at_random(n, 0.8, 0.5, tally);
  }
  MESSAGE(tally.collapsed << " collapsed, " << tally.refused << " refused; " << tally.on_boundary
                          << " on the boundary");
  CHECK(tally.collapsed > 100);
  CHECK(tally.refused > 100);
  CHECK(tally.on_boundary > 10);
}

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
