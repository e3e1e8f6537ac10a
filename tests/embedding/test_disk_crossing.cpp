// SPDX-License-Identifier: MIT
// Crossings of disks against the exact test of all pairs of facets: of cones and open fans, once or
// twice around, with facets at them, in them and beside them. Half of them lie on a small grid,
// where touching is common.
#include "embedding/disk_crossing.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "base/triangle.h"
#include "embedding/triangle_pair.h"
#include "exact/predicates.h"

namespace deliso {
namespace {

// The apex is vertex 0, the rim the next ones, and 12 others follow. All lie at different places.
std::vector<Vec3> random_points(Random& random, std::uint32_t rim, bool on_grid) {
  const double turn = (1 + random.below(2)) * 2 * std::numbers::pi / rim;
  std::vector<Vec3> points;
  while (points.size() < rim + 13) {
    const double angle = turn * (static_cast<double>(points.size()) + random.uniform());
    Vec3 p{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.3, 0.3)};
    if (points.size() <= rim) p = {std::cos(angle), std::sin(angle), p.z};
    if (points.empty()) p = {0, 0, 0.1};
    for (int axis = 0; axis < 3 && on_grid; ++axis) p[axis] = random.below(axis < 2 ? 4 : 2);
    if (std::ranges::find(points, p) == points.end()) points.push_back(p);
  }
  return points;
}

}  // namespace

TEST_CASE("a disk crosses what a facet of it crosses, and itself where two of its facets cross") {
  std::array<int, 2> flat{}, itself{}, others{};
  DiskCrossing crossing;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const std::uint32_t rim = 3 + random.below(6);
    const std::vector<Vec3> points = random_points(random, rim, seed % 2 == 0);
    Disk disk;
    const std::uint32_t facets = rim - random.below(2);
    for (std::uint32_t k = 0; k < facets; ++k) {
      disk.facets.push_back(triangle_of(1 + k, 1 + (k + 1) % rim, 0));
    }
    REQUIRE(disk.link());
    const auto is_flat = [&](const Triangle& t) {
      return collinear(points[t[0]], points[t[1]], points[t[2]]);
    };
    std::vector<Vec3> normals;
    for (const auto& [a, b, c] : disk.facets) {
      normals.push_back(area_normal(points[a], points[b], points[c]));
    }
    const BoxGrid grid({{-1, -1, -1}, {4, 4, 4}}, 1);
    const bool has_flat = std::ranges::any_of(disk.facets, is_flat);
    ++flat[has_flat];
    REQUIRE(crossing.begin(points, disk, normals, grid) != has_flat);
    if (has_flat) continue;

    bool expected = false;
    for (std::size_t f = 0; f < facets; ++f) {
      for (std::size_t g = 0; g < f; ++g) {
        expected |= triangles_intersect(points, disk.facets[f], disk.facets[g]);
      }
    }
    ++itself[expected];
    CHECK(crossing.crosses_itself(kNoId) == expected);
    if (facets == rim) CHECK(crossing.crosses_itself(VertexId(0)) == expected);

    for (int n = 0; n < 20; ++n) {
      Triangle t;
      for (VertexId& v : t) v = VertexId(random.below(static_cast<std::uint32_t>(points.size())));
      if (is_flat(t)) continue;
      const bool crosses = std::ranges::any_of(disk.facets, [&](const Triangle& facet) {
        return triangles_intersect(points, facet, t);
      });
      ++others[crosses];
      CHECK(crossing.crosses(t, grid.box_of(points, t)) == crosses);
    }
  }
  for (const auto& seen : {flat, itself, others}) {
    CHECK(std::ranges::min(seen) > 50);
  }
}

}  // namespace deliso
