// SPDX-License-Identifier: MIT
#include "more/bodies/bodies.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "check/check_mesh.h"
#include "check/place_faults.h"
#include "check/quality.h"

using namespace deliso;

namespace {

// Two balls that overlap, cut at the plane in between, in a background; voxels are 1 x 1 x 1.
const Vec3 kCenters[2] = {{11, 15.3, 14.6}, {20, 15.3, 14.6}};
constexpr double kRadius = 7;

BodyField body_field(int body, Index3 first, Index3 last) {
  const auto ball = [](const Vec3& p, int n) { return kRadius - distance(p, kCenters[n]); };
  std::vector<float> samples;
  for (int k = first.k; k <= last.k; ++k) {
    for (int j = first.j; j <= last.j; ++j) {
      for (int i = first.i; i <= last.i; ++i) {
        const Vec3 p{double(i), double(j), double(k)};
        const double one = ball(p, 0), two = ball(p, 1);
        samples.push_back(static_cast<float>(body == 0   ? -std::max(one, two)
                                             : body == 1 ? one - std::max(0.0, two)
                                                         : two - std::max(0.0, one)));
      }
    }
  }
  const Index3 n{last.i - first.i + 1, last.j - first.j + 1, last.k - first.k + 1};
  return {Volume::from_samples(n, {1, 1, 1}, samples),
          {double(first.i), double(first.j), double(first.k)}};
}

Partition balls() {
  return Partition({body_field(0, {0, 0, 0}, {31, 30, 29}), body_field(1, {1, 5, 5}, {22, 26, 25}),
                    body_field(2, {9, 5, 5}, {31, 26, 25})});
}

// Points of both spheres, and of the disk between them.
std::vector<InterfaceSeed> seeds() {
  std::vector<InterfaceSeed> all;
  for (const Vec3& center : kCenters) {
    for (int n = 0; n < 400; ++n) {
      const double z = (n + 0.5) / 200 - 1, turn = n * std::numbers::pi * (3 - std::sqrt(5)),
                   r = std::sqrt(1 - z * z);
      all.push_back({center + kRadius * Vec3{r * std::cos(turn), r * std::sin(turn), z}, 1.2});
    }
  }
  for (int n = 0; n < 60; ++n) {
    const double turn = n * std::numbers::pi * (3 - std::sqrt(5)), r = 5 * std::sqrt(n / 60.);
    all.push_back({{15.5, 15.3 + r * std::cos(turn), 14.6 + r * std::sin(turn)}, 1.2});
  }
  return all;
}

}  // namespace

TEST_CASE("bodies that touch are closed manifolds with common facets, and no facets cross") {
  const InterfaceMesh mesh = mesh_interfaces(balls(), seeds(), 0.1);
  std::vector<Triangle> all;
  std::map<std::array<BodyId, 2>, int> facets;
  for (const auto& [v, bodies] : mesh.facets) {
    all.push_back(v);
    ++facets[bodies];
    for (const VertexId corner : v) {
      const Vec3& p = mesh.points[corner.number()];
      const bool inner = bodies == std::array<BodyId, 2>{2, 1};
      const double off =
          inner ? std::fabs(p.x - 15.5) : std::fabs(distance(p, kCenters[bodies[1] - 1]) - kRadius);
      CHECK(off < 0.15);
    }
  }
  REQUIRE(facets.size() == 3);
  CHECK(facets[{0, 1}] > 200);
  CHECK(facets[{0, 2}] > 200);
  CHECK(facets[{2, 1}] > 50);
  CHECK(find_place_faults(mesh.points, all).crossings == 0);
  CHECK(mesh.largest_distance <= 0.1);
  for (const BodyId body : {1, 2}) {
    const TriMesh one = mesh.mesh_of(body);
    CHECK(check_mesh(one).empty());
    CHECK(mesh_topology(one).counts() == TopologyCounts{1, 2, 0});
    CHECK(mesh.topology[body] == TopologyCounts{1, 2, 0});
    CHECK(mesh.is_manifold[body] == 1);
    // A ball less a cap of height 2.5. Triangles lie inside it.
    const double cap = std::numbers::pi * 2.5 * 2.5 * (kRadius - 2.5 / 3);
    const double ball = 4 * std::numbers::pi / 3 * kRadius * kRadius * kRadius;
    CHECK(enclosed_volume(one) == doctest::Approx(ball - cap).epsilon(0.03));
  }
  const InterfaceMesh again = mesh_interfaces(balls(), seeds(), 0.1);
  CHECK(again.points == mesh.points);
}

TEST_CASE("a tie of three fields is a point of the circle where the bodies meet") {
  const Partition partition = balls();
  const std::array<BodyId, 3> three{1, 2, 0};
  const auto p = partition.tie({15, 21, 15}, three, 2);
  REQUIRE(p.has_value());
  CHECK(std::fabs(p->x - 15.5) < 0.05);
  CHECK(std::fabs(distance(*p, kCenters[0]) - kRadius) < 0.15);
  CHECK_FALSE(partition.tie({15, 15, 15}, three, 2).has_value());
  CHECK(partition.body_at(kCenters[1]) == 2);
  CHECK(partition.body_at({-9, 0, 0}) == 0);
}
