// SPDX-License-Identifier: MIT
// The oracle against brute force over all voxels. Each hit lies on Sigma and in its voxel, and hits
// are odd in number exactly between points on different sides.
#include "cases.h"
#include "isosurface/isosurface.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "fields.h"
#include "isosurface/voxel_ray.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

// Clips every voxel of the volume against the line and solves it if a piece is left.
std::vector<Hit> brute_force(const TestField& field, const LatticeLine& line, Range range,
                             CubicMethod method) {
  std::vector<Hit> hits;
  const Volume& volume = field.volume;
  const Index3 n = volume.voxels();
  if (!line.valid()) return hits;
  for_each_index(n, [&](int i, int j, int k) {
    const VoxelSpan span = line.span({i, j, k}, range);
    if (span.empty()) return;
    Corners corners = volume.corners({i, j, k});
    for (double& c : corners) c -= field.kappa;
    // Of the first root by the sample's side, of the next by turns.
    bool leaves = patch_along(corners, span.u0, span.u1)[0] >= 0;
    for (const double s : find_intersections(corners, span, method)) {
      hits.push_back({parameter_at(span, s), point_at(span, s, volume), leaves});
      leaves = !leaves;
    }
  });
  std::stable_sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
  return hits;
}

double range_of(const Corners& c) {
  return *std::max_element(c.begin(), c.end()) - *std::min_element(c.begin(), c.end());
}

// True if the point is on Sigma to 1e-9 of the voxel's range, and inside the box.
bool on_surface(const TestField& field, const Vec3& point) {
  const double range = range_of(field.volume.corners(field.volume.voxel_at(point)));
  return field.volume.box().contains(point) &&
         std::abs(field.volume.value(point) - field.kappa) <= 1e-9 * range;
}

// Returns the side of the point, 0 if it is too near to Sigma to say.
int side_of(const TestField& field, const Vec3& point) {
  const double g = field.volume.value(point) - field.kappa;
  const double range = range_of(field.volume.corners(field.volume.voxel_at(point)));
  return std::abs(g) <= 1e-6 * range ? 0 : g > 0 ? 1 : -1;
}

}  // namespace

TEST_CASE("intersect equals brute force over all voxels") {
  for (const TestField& field : test_fields()) {
    const VoxelTree tree(field.volume);
    for (const CubicMethod method : {CubicMethod::isolation, CubicMethod::schwarze}) {
      CAPTURE(field.name);
      const Isosurface surface(field.volume, tree, field.kappa, method);
      SearchCounters counters;
      std::vector<Hit> hits;
      std::size_t found = 0, parities = 0;
      const std::uint64_t trials = test::cases(method == CubicMethod::isolation ? 100'000 : 20'000);
      for (std::uint64_t seed = 0; seed < trials; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        const Segment r = hard_segment(random, field.volume);
        surface.intersect(r, hits, counters);
        const LatticeLine line = tree.lattice_line(r.a, r.direction());
        const std::vector<Hit> expected = brute_force(field, line, {0, 1}, method);

        REQUIRE(hits.size() == expected.size());
        for (std::size_t n = 0; n < hits.size(); ++n) {
          REQUIRE(hits[n].t == expected[n].t);
          if (n > 0) REQUIRE(hits[n].leaves != hits[n - 1].leaves);
          REQUIRE(on_surface(field, hits[n].point));
          REQUIRE(hits[n].t >= 0);
          REQUIRE(hits[n].t <= 1);
          const double slack = 1e-12 * (1 + length(r.a) + length(r.b));
          REQUIRE(distance(hits[n].point, r.at(hits[n].t)) <= slack);
        }
        found += hits.size();

        // Between any two points of the segment clear of Sigma, by the samples alone.
        double last_t = 0;
        int last_side = 0;
        for (int step = 0; step <= 6; ++step) {
          const double t = step == 0 ? 0 : step == 6 ? 1 : random.uniform(last_t, 1);
          const int side = field.volume.box().contains(r.at(t)) ? side_of(field, r.at(t)) : 0;
          if (side != 0 && last_side != 0) {
            const auto between = std::count_if(hits.begin(), hits.end(), [&](const Hit& hit) {
              return last_t <= hit.t && hit.t <= t;
            });
            REQUIRE((between % 2 == 1) == (side != last_side));
            ++parities;
          }
          const auto next =
              std::find_if(hits.begin(), hits.end(), [&](const Hit& hit) { return hit.t > t; });
          if (side != 0 && next != hits.end()) REQUIRE(next->leaves == (side > 0));
          last_t = t;
          last_side = side;
        }
      }
      CHECK(found > trials / 4);
      CHECK(parities > 2 * trials);
      CHECK(counters.searches == trials);
    }
  }
}

TEST_CASE("nearest equals the nearest of all brute-force hits") {
  for (const TestField& field : test_fields()) {
    CAPTURE(field.name);
    const VoxelTree tree(field.volume);
    const Isosurface surface(field.volume, tree, field.kappa);
    SearchCounters counters;
    std::size_t found = 0;
    const std::uint64_t kTrials = test::cases(100'000);
    for (std::uint64_t seed = 0; seed < kTrials; ++seed) {
      CAPTURE(seed);
      Random random(seed + 1'000'000);
      const Segment r = hard_segment(random, field.volume);
      const double size = length(r.direction());
      const Vec3 direction = size > 0 ? r.direction() / size : Vec3{0, 0, 0};
      const double part = random.uniform();
      const double limit = std::ldexp(part, static_cast<int>(random.below(12)) - 4);
      const std::optional<Hit> hit = surface.nearest(r.a, direction, limit, counters);

      const LatticeLine line = tree.lattice_line(r.a, direction);
      const std::vector<Hit> all =
          brute_force(field, line, {-limit, limit}, CubicMethod::isolation);
      const auto best = std::min_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
        return std::abs(a.t) < std::abs(b.t) || (std::abs(a.t) == std::abs(b.t) && a.t > b.t);
      });
      REQUIRE(hit.has_value() == (best != all.end()));
      if (!hit) continue;
      REQUIRE(hit->t == best->t);
      REQUIRE(hit->leaves == best->leaves);
      REQUIRE(on_surface(field, hit->point));
      REQUIRE(std::abs(hit->t) <= limit);
      ++found;
    }
    CHECK(found > kTrials / 5);
    CHECK(counters.searches == kTrials);
    CHECK(counters.searches_with_hit == found);
  }
}

TEST_CASE("lines without length, not finite or outside the box have no hits") {
  const TestField field = test_fields().front();
  const VoxelTree tree(field.volume);
  const Isosurface surface(field.volume, tree, field.kappa);
  SearchCounters counters;
  std::vector<Hit> hits;
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  for (const double bad : {inf, -inf, nan, 1e308}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 p{3, 4, 5};
      p[axis] = bad;
      surface.intersect({p, {1, 2, 3}}, hits, counters);
      CHECK(hits.empty());
      CHECK(!surface.nearest(p, {0, 0, 1}, 100, counters));
    }
  }
  CHECK(!surface.nearest({3, 4, 5}, {0, 0, 0}, 100, counters));
  CHECK(!surface.nearest({3, 4, 5}, {nan, 0, 1}, 100, counters));
  // Unlimited search is fine.
  CHECK(surface.nearest({3.3, 4.4, 5.5}, {0, 0, 1}, inf, counters));
}

TEST_CASE("an isovalue beyond the samples has no surface") {
  const TestField field = test_fields().front();
  const VoxelTree tree(field.volume);
  SearchCounters counters;
  std::vector<Hit> hits;
  for (const double kappa : {-1e9, -1.0, 255.5, 1e9}) {
    const Isosurface surface(field.volume, tree, kappa);
    surface.intersect({{0, 0, 0}, {11, 9, 10}}, hits, counters);
    CHECK(hits.empty());
    CHECK(!surface.nearest({5, 5, 5}, {0, 0, 1}, 100, counters));
  }
  CHECK(counters.computations == 0);
}
