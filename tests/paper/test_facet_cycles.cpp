// SPDX-License-Identifier: MIT
// What Figure 5 leaves out: a sample of every component, and a test of Voronoi facets.
#include "paper/facet_cycles.h"

#include <doctest/doctest.h>

#include "check/check_mesh.h"
#include "contour/contour.h"
#include "paper/program.h"

using namespace deliso;
using namespace deliso::test;
using paper::Options;

namespace {

struct Ball {
  Vec3 center;
  double radius;
};

// Balls of .8 to 2.5 voxels, apart from each other: one in each of the cubes of a 3 x 3 x 3 grid.
std::vector<Ball> some_balls(std::uint64_t seed) {
  Random random(seed);
  std::vector<Ball> balls;
  for (int n = 0; n < 27; ++n) {
    const Vec3 cube{8. * (n % 3), 8. * (n / 3 % 3), 8. * (n / 9)};
    const double radius = random.uniform(0.8, 2.5);
    const auto at = [&] { return random.uniform(radius + 0.7, 8 - radius - 0.7); };
    const double x = at(), y = at();
    balls.push_back({cube + Vec3{x, y, at()}, radius});
  }
  return balls;
}

Field field_of(const std::vector<Ball>& balls) {
  return {sampled<float>(
              {25, 25, 25}, {1, 1, 1},
              [&](int i, int j, int k) {
                double most = -100;
                for (const Ball& b : balls) {
                  most = std::max(most, b.radius - distance(b.center, {1. * i, 1. * j, 1. * k}));
                }
                return most;
              }),
          0.01};
}

}  // namespace

TEST_CASE("points below regions: every component has one, on the surface") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    const std::vector<Ball> balls = some_balls(seed);
    Program program(field_of(balls), few_vertices());
    const std::vector<Vec3> points = paper::points_below_regions(program.sigma);
    for (const Vec3& p : points) {
      CHECK(std::fabs(program.volume.value(p) - program.sigma.kappa()) < 1e-6);
    }
    for (const Ball& b : balls) {
      // A ball between all samples has no region, and no surface.
      const bool has_sample =
          program.volume.sample(static_cast<int>(std::lround(b.center.x)),
                                static_cast<int>(std::lround(b.center.y)),
                                static_cast<int>(std::lround(b.center.z))) >= program.sigma.kappa();
      CHECK(has_sample == std::ranges::any_of(points, [&](const Vec3& p) {
              return distance(p, b.center) < b.radius + 0.7;
            }));
    }
  }
}

TEST_CASE(
    "points below regions: a cavity has one, where no line through the lowest sample meets it") {
  const Vec3 ball{6, 6, 6}, cavity{8, 6, 6};
  const auto field = [&](int i, int j, int k) {
    const Vec3 p{1. * i, 1. * j, 1. * k};
    return std::min(4.4 - distance(p, ball), distance(p, cavity) - 1.4);
  };
  Program program({sampled<float>({13, 13, 13}, {1, 1, 1}, field), 0.01}, few_vertices());
  CHECK(std::ranges::any_of(paper::points_below_regions(program.sigma),
                            [&](const Vec3& p) { return distance(p, cavity) < 1.6; }));
}

TEST_CASE("Recover leaves no facet cycle") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    Options options = few_vertices();
    options.facet_cycles = true;
    options.lines = 10;
    Program program(field_of(some_balls(seed)), options);
    program.recovery.recover();
    SearchCounters counters;
    for (SiteId q = 1; q < program.del().del().vertex_capacity(); ++q) {
      if (program.del().is_auxiliary(q)) continue;
      const double least = Options::kClosest * program.report.r_min;
      CHECK_FALSE(paper::facet_cycle(program.del(), q, least, counters));
    }
  }
}

TEST_CASE("a facet cycle: a point of the surface, in a Voronoi facet whose edges do not meet it") {
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    Options options = few_vertices();
    options.facet_cycles = true;
    options.lines = 6;
    Program program(field_of(some_balls(seed)), options);
    const Triangulation& t = program.del().del();
    SearchCounters counters;
    for (SiteId q = 1; q < t.vertex_capacity(); ++q) {
      if (program.del().is_auxiliary(q)) continue;
      const auto x = paper::facet_cycle(program.del(), q, 0.01, counters);
      if (!x) continue;
      ++found;
      CHECK(std::fabs(program.volume.value(*x) - program.sigma.kappa()) < 1e-6);
      const double far = distance(*x, t.point(q));
      CHECK(far > 0.01);
      std::vector<SiteId> others;
      for (SiteId p = 1; p < t.vertex_capacity(); ++p) {
        CHECK(distance(*x, t.point(p)) > far - 1e-9);
        if (p != q && distance(*x, t.point(p)) < far + 1e-9) others.push_back(p);
      }
      REQUIRE(others.size() == 1);
      for_each_finite_facet(t, [&](Facet f) {
        const SiteTriangle v = facet_vertices(t, f);
        if (std::ranges::count(v, q) == 0 || std::ranges::count(v, others[0]) == 0) return;
        CHECK(program.del().hits(f).empty());
      });
    }
  }
  CHECK(found > 20);
}

TEST_CASE("a vertex whose D_q is empty gets company: what the sample meets is in the mesh") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    const std::vector<Ball> balls = some_balls(seed);
    Options options = few_vertices();
    options.lines = 10;
    options.seed = seed;
    options.stop_after_recover = true;
    Program program(field_of(balls), options);
    const Triangulation& t = program.del().del();
    std::size_t met = 0;
    for (const Ball& b : balls) {
      for (SiteId q = 1; q < t.vertex_capacity(); ++q) {
        if (distance(t.point(q), b.center) > b.radius + 0.7) continue;
        ++met;
        break;
      }
    }
    REQUIRE(met > 1);
    paper::Report report;
    const TriMesh mesh = run(field_of(balls), options, report);
    CHECK(mesh_topology(mesh).components.size() >= met);
    CHECK(report.vertices_alone == 0);
  }
}

TEST_CASE("with facet cycles all balls are found, however few lines there are") {
  std::size_t missed = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    const Field field = field_of(some_balls(seed));
    Options options = few_vertices();
    options.lines = 10;
    options.seed = seed;
    options.facet_cycles = options.stop_after_recover = true;
    paper::Report report;
    const TopologyCounts exact =
        build_contour(field.volume, geometric_isovalue(SampleType::f32, field.isovalue))
            .summary.topology();
    CHECK(mesh_topology(run(field, options, report)).counts() == exact);
    options.facet_cycles = false;
    missed += exact.components - mesh_topology(run(field, options, report)).components.size();
  }
  CHECK(missed > 0);  // as published
}
