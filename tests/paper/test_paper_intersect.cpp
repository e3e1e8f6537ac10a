// SPDX-License-Identifier: MIT
// Figure 12 against all voxels, and the counts of which Table 4 is made.
#include "paper/intersect.h"

#include <doctest/doctest.h>

#include "paper/program.h"

using namespace deliso;
using namespace deliso::test;
using paper::Sigma;

namespace {

// Voxels with samples on both sides that the segment runs through.
std::uint64_t active_voxels_on(const Segment& r, const Volume& volume, double kappa) {
  std::uint64_t count = 0;
  for_each_index(volume.voxels(), [&](int i, int j, int k) {
    const Box3 box{volume.position({i, j, k}), volume.position({i + 1, j + 1, k + 1})};
    const Range t = clip(r.a, r.direction(), {0, 1}, box);
    int inside = 0;
    for (const double g : volume.corners({i, j, k})) inside += g >= kappa;
    count += t.lo < t.hi && inside != 0 && inside != 8;
  });
  return count;
}

// Where g - kappa changes its sign along r, by many small steps. Two passages within one are
// missed.
constexpr int kSteps = 3000;
std::vector<double> passages(const Segment& r, const Volume& volume, double kappa) {
  const auto inside = [&](double t) { return volume.value(r.at(t)) >= kappa; };
  std::vector<double> found;
  bool before = inside(0);
  for (int n = 1; n <= kSteps; ++n) {
    double lo = (n - 1.0) / kSteps, hi = 1.0 * n / kSteps;
    const bool now = inside(hi);
    if (now == before) continue;
    while (hi - lo > 1e-12) {
      const double middle = 0.5 * (lo + hi);
      (inside(middle) == before ? lo : hi) = middle;
    }
    found.push_back(hi);
    before = now;
  }
  return found;
}

bool equals(const SearchCounters& c, std::array<std::uint64_t, 4> counts) {
  return std::array{c.searches, c.searches_with_hit, c.computations, c.computations_with_hit} ==
         counts;
}

}  // namespace

TEST_CASE("Intersect finds every passage, at one computation per active voxel") {
  Random random(1);
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto [volume, isovalue] = noise(seed, 9);
    const double kappa = geometric_isovalue(volume.type(), isovalue);
    const VoxelTree tree(volume);
    for (const CubicMethod solver : {CubicMethod::schwarze, CubicMethod::isolation}) {
      Sigma sigma(tree, kappa, solver);
      for (int n = 0; n < 20; ++n) {
        const auto somewhere = [&] {
          return Vec3{random.uniform(0, 8), random.uniform(0, 8), random.uniform(0, 8)};
        };
        const Segment r{somewhere(), somewhere()};
        SearchCounters counters;
        const std::span<const Hit> hits = sigma.intersect(r, counters);
        const std::vector<double> expected = passages(r, volume, kappa);
        std::size_t next = 0;
        bool inside = volume.value(r.a) >= kappa;
        for (std::size_t k = 0; k < hits.size(); ++k) {
          CHECK(distance(hits[k].point, r.at(hits[k].t)) < 1e-9);
          CHECK(hits[k].leaves == inside);
          inside = !inside;
          if (next < expected.size() && std::fabs(hits[k].t - expected[next]) < 1e-6) {
            ++next;
          } else {
            // The other hit of a pair that the steps missed.
            REQUIRE(k + 1 < hits.size());
            CHECK(hits[k + 1].t - hits[k].t < 1.0 / kSteps);
            inside = !inside;
            ++k;
          }
        }
        CHECK(next == expected.size());
        const std::uint64_t active = active_voxels_on(r, volume, kappa);
        CHECK(equals(counters, {1, !hits.empty(), active, hits.empty() ? 0 : active}));
        found += hits.size();
      }
    }
  }
  CHECK(found > 100);
}

TEST_CASE("voxels are collected by the tree") {
  // The samples change after the tree was made. It knows of nothing to be collected.
  std::vector<float> samples(5 * 5 * 5, 0);
  const Volume volume({5, 5, 5}, {1, 1, 1}, sample_type_of<float>(),
                      reinterpret_cast<const std::byte*>(samples.data()), nullptr);
  const VoxelTree tree(volume);
  for (std::size_t n = 0; n < samples.size(); ++n) samples[n] = n % 5 < 2 ? 1 : -1;
  const Segment across{{0, 2, 2}, {4, 2.1, 2.3}};
  SearchCounters counters;
  CHECK(Sigma(tree, 0, CubicMethod::schwarze).intersect(across, counters).empty());
  CHECK(equals(counters, {1, 0, 0, 0}));
  const VoxelTree new_tree(volume);
  Sigma sigma(new_tree, 0, CubicMethod::schwarze);
  CHECK(sigma.intersect(across, counters).size() == 1);
  CHECK(equals(counters, {2, 1, 1, 1}));
  // Beside the volume there is no voxel.
  CHECK(sigma.intersect({{5, 0, 0}, {6, 1, 1}}, counters).empty());
  CHECK(equals(counters, {3, 1, 1, 1}));
}

TEST_CASE("Stage 2's search finds the hit nearest to the circumcenter, with fewer computations") {
  Random random(2);
  const auto [volume, isovalue] = noise(1, 9);
  const double kappa = geometric_isovalue(volume.type(), isovalue);
  const VoxelTree tree(volume);
  Sigma sigma(tree, kappa, CubicMethod::schwarze);
  SearchCounters stepping, whole;
  int found = 0;
  for (int n = 0; n < 300; ++n) {
    const Vec3 center{random.uniform(0, 8), random.uniform(0, 8), random.uniform(0, 8)};
    const Vec3 along{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const Vec3 direction = along / length(along);
    const double limit = random.uniform(0.5, 4);
    const auto hit = sigma.nearest(center, direction, limit, stepping);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Hit& x :
         sigma.intersect({center - limit * direction, center + limit * direction}, whole)) {
      nearest = std::min(nearest, distance(x.point, center));
    }
    REQUIRE(hit.has_value() == (nearest <= limit));
    if (!hit) continue;
    ++found;
    CHECK(std::fabs(distance(hit->point, center) - nearest) < 1e-9);
  }
  CHECK(found > 100);
  CHECK(stepping.computations < whole.computations);
  CHECK(stepping.searches_with_hit == whole.searches_with_hit);
}
