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

// The pieces of the line in active voxels, in no order: a computation each, of Table 4's CPI.
std::vector<VoxelSpan> active_pieces(const TestField& field, const LatticeLine& line, Range range) {
  std::vector<VoxelSpan> spans;
  if (!line.valid()) return spans;
  for_each_index(field.volume.voxels(), [&](int i, int j, int k) {
    const VoxelSpan span = line.span({i, j, k}, range);
    if (span.empty()) return;
    const Corners c = field.volume.corners({i, j, k});
    const auto inside =
        std::count_if(c.begin(), c.end(), [&](double v) { return v >= field.kappa; });
    if (inside > 0 && inside < 8) spans.push_back(span);
  });
  return spans;
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

// A search costs a computation for every active voxel, with hits or not.
TEST_CASE("intersect equals brute force over all voxels") {
  for (const TestField& field : test_fields()) {
    const VoxelUnits units(field.volume);
    for (const CubicMethod method : {CubicMethod::isolation, CubicMethod::schwarze}) {
      CAPTURE(field.name);
      const Isosurface surface(field.volume, field.kappa, method);
      SearchCounters counters, expected_counts;
      std::vector<Hit> hits;
      std::size_t found = 0, parities = 0;
      const std::uint64_t trials = test::cases(method == CubicMethod::isolation ? 30'000 : 10'000);
      for (std::uint64_t seed = 0; seed < trials; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        const Segment r = hard_segment(random, field.volume);
        surface.intersect(r, hits, counters);
        const LatticeLine line = units.line(r.a, r.direction());
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
        const std::size_t active = active_pieces(field, line, {0, 1}).size();
        expected_counts += {1, !hits.empty(), active, hits.empty() ? 0 : active};
        REQUIRE(counters.computations == expected_counts.computations);
        REQUIRE(counters.computations_with_hit == expected_counts.computations_with_hit);

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
      CHECK(counters.searches_with_hit == expected_counts.searches_with_hit);
      // There are computations without a root, and searches of several computations.
      CHECK(counters.computations_with_hit < counters.computations);
      CHECK(counters.computations_with_hit > counters.searches_with_hit);
    }
  }
}

TEST_CASE("nearest equals the nearest of all brute-force hits") {
  for (const TestField& field : test_fields()) {
    CAPTURE(field.name);
    const VoxelUnits units(field.volume);
    const Isosurface surface(field.volume, field.kappa);
    SearchCounters counters;
    std::size_t found = 0;
    const std::uint64_t kTrials = test::cases(30'000);
    for (std::uint64_t seed = 0; seed < kTrials; ++seed) {
      CAPTURE(seed);
      Random random(seed + 1'000'000);
      const Segment r = hard_segment(random, field.volume);
      const double size = length(r.direction());
      const Vec3 direction = size > 0 ? r.direction() / size : Vec3{0, 0, 0};
      const double part = random.uniform();
      const double limit = std::ldexp(part, static_cast<int>(random.below(12)) - 4);
      const std::optional<Hit> hit = surface.nearest(r.a, direction, limit, counters);

      const LatticeLine line = units.line(r.a, direction);
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

TEST_CASE("a search for the nearest hit counts the active voxels that it must look at") {
  for (const TestField& field : test_fields()) {
    CAPTURE(field.name);
    const VoxelUnits units(field.volume);
    const Isosurface surface(field.volume, field.kappa);
    std::uint64_t without_hit = 0, several = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
      CAPTURE(seed);
      Random random(seed);
      const Segment r = hard_segment(random, field.volume);
      const double size = length(r.direction()), limit = std::ldexp(random.uniform(), 5);
      if (!(size > 0)) continue;
      SearchCounters counters;
      const Vec3 direction = r.direction() / size;
      const std::optional<Hit> hit = surface.nearest(r.a, direction, limit, counters);

      // All that begins nearer than the hit. The search looks ahead and back in turns, but for far
      // hits ahead first: to the first hit there, though one behind may be nearer.
      const LatticeLine line = units.line(r.a, direction);
      double end = limit, end_ahead = limit;
      if (hit) end = end_ahead = std::abs(hit->t);
      if (hit && hit->t < 0) {
        end_ahead = limit;
        for (const Hit& h : brute_force(field, line, {-limit, limit}, CubicMethod::isolation))
          if (h.t >= 0) end_ahead = std::min(end_ahead, h.t);
      }
      std::size_t least = 0, most = 0;
      for (const VoxelSpan& span : active_pieces(field, line, {-limit, limit})) {
        const bool is_ahead = span.t0 >= 0;
        const double begin = std::max({0.0, span.t0, -span.t1});
        least += begin < end;
        most += begin <= (is_ahead ? end_ahead : end);
      }
      REQUIRE(counters.searches == 1);
      REQUIRE(counters.computations >= least);
      REQUIRE(counters.computations <= most);
      REQUIRE(counters.computations_with_hit == (hit ? counters.computations : 0));
      without_hit += hit ? 0 : counters.computations;
      several += hit && counters.computations > 1;
    }
    CHECK(without_hit > 50);
    CHECK(several > 50);
  }
}

TEST_CASE("lines without length, not finite or outside the box have no hits") {
  const TestField field = test_fields().front();
  const Isosurface surface(field.volume, field.kappa);
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

// The search for the nearest hit began in the voxel of its center without a look at whether there
// is one, and read beyond the samples.
TEST_CASE("a volume without a voxel has no surface") {
  for (const Index3 dims : {Index3{1, 1, 1}, Index3{1, 1, 9}, Index3{9, 8, 1}, Index3{1, 9, 8}}) {
    CAPTURE(dims.i);
    CAPTURE(dims.k);
    const Volume volume =
        sampled<float>(dims, {1, 1, 1}, [](int i, int j, int k) { return (i + j + k) % 2; });
    const Isosurface surface(volume, 0.5);
    SearchCounters counters;
    std::vector<Hit> hits;
    for (const Vec3& direction : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0.6, 0, 0.8}}) {
      surface.intersect({-9 * direction, 9 * direction}, hits, counters);
      CHECK(hits.empty());
      CHECK(!surface.nearest({0, 0, 0}, direction, 100, counters));
    }
    CHECK(counters.computations == 0);
  }
}

TEST_CASE("an isovalue beyond the samples has no surface") {
  const TestField field = test_fields().front();
  SearchCounters counters;
  std::vector<Hit> hits;
  for (const double kappa : {-1e9, -1.0, 255.5, 1e9}) {
    const Isosurface surface(field.volume, kappa);
    surface.intersect({{0, 0, 0}, {11, 9, 10}}, hits, counters);
    CHECK(hits.empty());
    CHECK(!surface.nearest({5, 5, 5}, {0, 0, 1}, 100, counters));
  }
  CHECK(counters.computations == 0);
}
