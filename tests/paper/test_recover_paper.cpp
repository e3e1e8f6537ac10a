// SPDX-License-Identifier: MIT
// What each step of Figure 5 leaves, and what no step of it can see.
#include "paper/recover.h"

#include <doctest/doctest.h>

#include <limits>

#include "base/random.h"
#include "deliso/deliso.h"
#include "deliso/fields.h"
#include "deliso/options.h"
#include "mesh/check_mesh.h"
#include "stage1/first_sample.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

// A field as InitTriangulation leaves it.
struct Begun {
  Begun(const Scene& scene, const Options& options)
      : parameters(resolve(options, scene.volume)),
        curves(BoundaryCurves(
            scene.surface, std::make_shared<const BoundaryLoops>(boundary_loops(scene.contour)))),
        recovery(scene.surface, curves,
                 init_triangulation(scene.contour, curves, scene.volume, parameters, report),
                 parameters, report) {}
  Begun(const Begun&) = delete;

  Report report;
  Parameters parameters;
  BoundaryCurves curves;
  Recovery recovery;
};

std::size_t facets_met_twice(const RestrictedDelaunay& restricted) {
  std::size_t count = 0;
  for (RecordId r = 0; r < restricted.record_capacity(); ++r) {
    count += restricted.effective_hits(r).size() > 1;
  }
  return count;
}

std::size_t vertices_without_disk(const RestrictedDelaunay& restricted) {
  std::size_t count = 0;
  std::vector<RecordId> star;
  std::vector<Triangle> triangles;
  for (SiteId q = 1; q < restricted.triangulation().vertex_capacity(); ++q) {
    if (restricted.is_auxiliary(q)) continue;
    restricted.star(q, star);
    triangles.clear();
    for (const RecordId r : star) triangles.push_back(as_mesh_triangle(restricted.triangle(r)));
    count += classify_star(VertexId(q.number()), triangles) != Star::disk;
  }
  return count;
}

}  // namespace

TEST_CASE("MultiIntersect leaves no edge met twice, ExtractManifold a disk everywhere") {
  std::size_t met_twice = 0, no_disk = 0;
  for (const char* name : {"torus", "linked_tori", "machine"}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      CAPTURE(name);
      CAPTURE(seed);
      const Scene scene = builtin_scene(name, 24);
      Options options = Options::paper();
      options.seed = seed;
      Begun begun(scene, options);
      met_twice += facets_met_twice(begun.recovery.restricted());
      begun.recovery.multi_intersect();
      CHECK(facets_met_twice(begun.recovery.restricted()) == 0);
      no_disk += vertices_without_disk(begun.recovery.restricted());
      begun.recovery.extract_manifold();
      CHECK(vertices_without_disk(begun.recovery.restricted()) == 0);
    }
  }
  MESSAGE("met twice at first: " << met_twice << ", without a disk after that: " << no_disk);
  // There was something to do.
  CHECK(met_twice > 0);
  CHECK(no_disk > 0);
}

// A split may take several vertices, and each brings facets: all are looked at, not the last one's.
TEST_CASE("MultiIntersect leaves no edge met twice where edges on the box are split for it") {
  constexpr int kSize = 9;
  std::uint64_t splits = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    std::vector<double> noise(kSize * kSize * kSize);
    for (double& x : noise) x = random.uniform(-1, 1);
    const auto mean_at = [&](int i, int j, int k) {
      double sum = 0;
      int count = 0;
      for (int c = std::max(k - 1, 0); c <= std::min(k + 1, kSize - 1); ++c) {
        for (int b = std::max(j - 1, 0); b <= std::min(j + 1, kSize - 1); ++b) {
          for (int a = std::max(i - 1, 0); a <= std::min(i + 1, kSize - 1); ++a, ++count) {
            sum += noise[static_cast<std::size_t>(a + kSize * (b + kSize * c))];
          }
        }
      }
      return static_cast<float>(sum / count);
    };
    const Scene scene(sampled<float>({kSize, kSize, kSize}, {1, 1, 1}, mean_at), 0.02);
    Options options = Options::paper();
    options.samples = 5;
    Begun begun(scene, options);
    begun.recovery.protect_boundary();
    const std::uint64_t before = begun.report[Counter::boundary_splits_recover];
    begun.recovery.multi_intersect();
    splits += begun.report[Counter::boundary_splits_recover] - before;
    CHECK(facets_met_twice(begun.recovery.restricted()) == 0);
  }
  CHECK(splits > 300);
}

// At the maximum of its samples a surface is slivers of 1e-9 voxels, on the box between two curves.
TEST_CASE("curves very close to each other are not split down to r_min") {
  constexpr int kSize = 6, kMaximum = 3;
  Random random(1);
  std::vector<float> samples;
  for (int n = 0; n < kSize * kSize * kSize; ++n) {
    samples.push_back(static_cast<float>(random.below(kMaximum + 1)));
  }
  const Scene scene(Volume::from_samples({kSize, kSize, kSize}, {1, 1, 1}, samples),
                    kMaximum - 1e-9);
  Begun begun(scene, Options::paper());
  begun.recovery.recover();
  const std::uint64_t splits = begun.report[Counter::boundary_splits_recover];
  CAPTURE(splits);
  CHECK(splits > 0);
  CHECK(splits < 10'000);
}

TEST_CASE(
    "a component smaller than r_min has sites and no facet: it is lost, and that is counted") {
  constexpr int kSize = 24;
  const Scene scene(sampled<float>({kSize, kSize, kSize}, {1, 1, 1},
                                   [&](int i, int j, int k) {
                                     const auto ball = [&](double x, double y, double z, double r) {
                                       return r - std::sqrt((i - x) * (i - x) + (j - y) * (j - y) +
                                                            (k - z) * (k - z));
                                     };
                                     return std::max(ball(9.1, 11.2, 10.7, 6.4),
                                                     ball(20.1, 20, 20.2, 0.7));
                                   }),
                    0);
  REQUIRE(scene.contour.summary.components.size() == 2);
  Options options = Options::paper();
  options.r_min = {2, Length::Unit::voxel};
  Report report;
  options.stop_after_recover = true;
  const DelaunayMesh recovered = delaunay_mesh(scene.surface, ContourMesh(scene.contour), options,
                                               resolve(options, scene.volume), report);
  CHECK(report[Counter::unresolved_facets] == 0);
  CHECK(report[Counter::unresolved_vertices] > 0);
  CHECK(mesh_topology(recovered.mesh.mesh).components.size() == 1);
}

TEST_CASE("ApproximateGeom leaves no facet that violates a criterion, new ones included") {
  for (const char* name : {"torus", "linked_tori"}) {
    CAPTURE(name);
    const Scene scene = builtin_scene(name, 24);
    Begun begun(scene, Options::paper());
    begun.recovery.multi_intersect();
    begun.recovery.extract_manifold();
    const RestrictedDelaunay& restricted = begun.recovery.restricted();
    const Triangulation& t = restricted.triangulation();
    const std::size_t before = t.vertex_capacity();
    std::vector<double> no_poles;
    begun.recovery.approximate_geom(begun.parameters.recovery, no_poles);
    CHECK(t.vertex_capacity() > before + 100);
    CHECK(begun.report[Counter::capped_insertions] == 0);
    std::size_t bad = 0;
    for (RecordId r = 0; r < restricted.record_capacity(); ++r) {
      if (!restricted.is_restricted(r)) continue;
      const auto [a, b, c] = restricted.triangle(r);
      const FacetShape shape =
          measure(t.point(a), t.point(b), t.point(c), restricted.surface_point(r));
      bad += violation(shape, begun.parameters.recovery) > 1;
    }
    CHECK(bad == 0);
  }
}

TEST_CASE("without ApproximateGeom Stage 1 hands over fewer points") {
  const Scene scene = builtin_scene("orbital", 64);
  Options options = Options::paper();
  options.stop_after_recover = true;
  const auto recovered = [&] {
    Report report;
    const TriMesh mesh = mesh_isosurface(scene.volume, scene.surface.kappa(), options, report);
    CHECK(check_mesh(mesh).empty());
    return report.points_recovered;
  };
  const std::uint64_t stated = recovered();
  options.epsilon = std::numeric_limits<double>::infinity();
  CHECK(recovered() < stated);
}
