// SPDX-License-Identifier: MIT
#include "more/bodies/bodies.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "base/random.h"
#include "check/check_mesh.h"
#include "check/place_faults.h"
#include "check/quality.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

constexpr Index3 kDims{31, 30, 29};

// The field of a body in all of a volume with voxels of 1 x 1 x 1.
template <class F>
Volume field(Index3 dims, F&& f) {
  std::vector<float> samples;
  for (int k = 0; k < dims.k; ++k) {
    for (int j = 0; j < dims.j; ++j) {
      for (int i = 0; i < dims.i; ++i) {
        const double value = f(Vec3{double(i), double(j), double(k)});
        samples.push_back(static_cast<float>(std::max(0.0, value)));
      }
    }
  }
  return Volume::from_samples(dims, {1, 1, 1}, samples);
}

// Two balls that overlap, cut at the plane in between, in a background.
const Vec3 kCenters[2] = {{11, 15.3, 14.6}, {20, 15.3, 14.6}};
constexpr double kRadius = 7;

Partition balls() {
  const auto ball = [](int n) {
    return field(kDims, [n](const Vec3& p) { return 40 + kRadius - distance(p, kCenters[n]); });
  };
  const Volume background = field(kDims, [](const Vec3&) { return 40; });
  return Partition(background, {background, ball(0), ball(1)}, 0, 1);
}

// Four cells that fill the box, and meet in a curve through it.
Partition quarters() {
  const Index3 dims{12, 11, 10};
  std::vector<Volume> fields;
  for (const Vec3& center : {Vec3{2, 2, 4}, {9, 3, 5}, {3, 8, 4}, {8, 9, 6}}) {
    fields.push_back(field(dims, [&](const Vec3& p) { return 100 - distance2(p, center); }));
  }
  const Volume shape = fields[0];
  return Partition(shape, std::move(fields), kNoId, 1);
}

Options options_with(int threads, bool cap) {
  Options options;
  options.threads = threads;
  options.cap = cap;
  return options;
}

}  // namespace

TEST_CASE("Euler numbers around samples are those of closed cubes, counted one by one") {
  Random random(5);
  for (int run = 0; run < 40; ++run) {
    const Index3 dims{2 + run % 4, 3, 2 + run % 3};
    const auto body = [&](const Vec3&) { return random.below(3) == 0 ? 2.0 : 0.0; };
    const Volume rest = field(dims, [](const Vec3&) { return 1; }), own = field(dims, body);
    const Partition partition(rest, {rest, own}, 0, 1);
    // A cell is named by twice its middle: a cube's coordinates are all odd, a corner's all even.
    std::array<std::set<std::array<int, 3>>, 2> cells;
    for_each_index(dims, [&](int i, int j, int k) {
      for_each_index({3, 3, 3}, [&](int x, int y, int z) {
        cells[partition.body_at({i, j, k})].insert({2 * i + x, 2 * j + y, 2 * k + z});
      });
    });
    for (const BodyId b : {0, 1}) {
      std::int64_t euler = 0;
      for (const auto& [x, y, z] : cells[b]) euler += (x + y + z) % 2 == 0 ? 2 : -2;
      CHECK(partition.euler_numbers()[b] == euler);
    }
  }
}

TEST_CASE("bodies that touch are closed manifolds with common facets, and no facets cross") {
  const Partition partition = balls();
  Report report;
  const InterfaceMesh mesh = mesh_interfaces(partition, options_with(2, false), report);
  std::vector<Triangle> all;
  std::map<std::array<BodyId, 2>, int> facets;
  std::map<VertexId, std::set<BodyId>> at;
  for (const auto& [v, bodies] : mesh.facets) {
    for (const VertexId corner : v) at[corner].insert(bodies.begin(), bodies.end());
  }
  for (const auto& [v, bodies] : mesh.facets) {
    all.push_back(v);
    ++facets[bodies];
    for (const VertexId corner : v) {
      const Vec3& p = mesh.points[corner.number()];
      const double off = bodies == std::array<BodyId, 2>{2, 1}
                             ? std::fabs(p.x - 15.5)
                             : std::fabs(distance(p, kCenters[bodies[1] - 1]) - kRadius);
      // A curve's vertices stay near the tetrahedra in which its samples say that it is.
      CHECK(off < (at[corner].size() == 2 ? 0.15 : 0.5));
    }
  }
  REQUIRE(facets.size() == 3);
  CHECK(facets[{0, 1}] > 100);
  CHECK(facets[{0, 2}] > 100);
  CHECK(facets[{2, 1}] > 5);
  CHECK(find_place_faults(mesh.points, all).crossings == 0);
  for (const BodyId body : {1, 2}) {
    const TriMesh one = mesh.mesh_of(body);
    CHECK(check_mesh(one).empty());
    CHECK(mesh_topology(one).counts() == TopologyCounts{1, 2, 0});
    CHECK(mesh.topology[body] == TopologyCounts{1, 2, 0});
    CHECK(mesh.exact[body] == TopologyCounts{1, 2, 0});
    // A ball less a cap of height 2.5. Triangles lie inside it.
    const double cap = std::numbers::pi * 2.5 * 2.5 * (kRadius - 2.5 / 3);
    const double ball = 4 * std::numbers::pi / 3 * kRadius * kRadius * kRadius;
    CHECK(enclosed_volume(one) == doctest::Approx(ball - cap).epsilon(0.03));
  }
  Report other;
  CHECK(mesh_interfaces(partition, options_with(1, false), other).points == mesh.points);
}

TEST_CASE("cells up to the box are closed with the box's own corners and faces") {
  const Partition partition = quarters();
  Report report;
  const InterfaceMesh mesh = mesh_interfaces(partition, options_with(1, true), report);
  const Box3 box = partition.shape().box();
  std::set<unsigned> corners;
  for (const Vec3& p : mesh.points) {
    const unsigned faces = box_faces_at(p, box);
    if (std::popcount(faces) == 3) corners.insert(faces);
  }
  CHECK(corners.size() == 8);
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const auto& [v, bodies] = mesh.facets[f];
    CHECK(partition.is_beyond(bodies[0]) == (f >= mesh.inner_facets));
    if (!partition.is_beyond(bodies[0])) continue;
    const unsigned face = 1u << (bodies[0] - partition.size());
    for (const VertexId corner : v) {
      CHECK((box_faces_at(mesh.points[corner.number()], box) & face) != 0);
    }
  }
  double volume = 0;
  for (BodyId body = 0; body < partition.size(); ++body) {
    const TriMesh one = mesh.mesh_of(body);
    CHECK(check_mesh(one).empty());
    CHECK(mesh.topology[body] == TopologyCounts{1, 2, 0});
    volume += enclosed_volume(one);
  }
  CHECK(volume == doctest::Approx(11 * 10 * 9));
}

TEST_CASE("a number of vertices is met from below, caps left out") {
  Options options = options_with(2, true);
  options.target_vertices = 250;
  Report report;
  const InterfaceMesh mesh = mesh_interfaces(quarters(), options, report);
  CHECK(report.vertices_refined <= 250);
  CHECK(report.vertices_refined > 200);
  CHECK(mesh.points.size() > report.vertices_refined);
  options.target_vertices = Options::kNoTarget;
  options.max_vertices = 20;
  CHECK_THROWS_WITH(mesh_interfaces(quarters(), options, report),
                    "more than --max-vertices 20 vertices needed");
  options.stop_after_stage1 = true;
  CHECK_THROWS_WITH(mesh_interfaces(quarters(), options, report),
                    "more than --max-vertices 20 vertices needed");
}

TEST_CASE("a point belongs to the body with the largest field, and ties to the smaller number") {
  const Index3 dims{2, 2, 2};
  const auto constant = [&](double value) {
    return field(dims, [=](const Vec3&) { return value; });
  };
  const Volume shape = constant(0);
  const Partition partition(shape, {constant(1), constant(2), constant(2)}, 1, 1);
  CHECK(partition.body_at({0, 1, 0}) == 1);
  CHECK(partition.samples() == std::vector<std::uint64_t>{0, 8, 0});
  const Partition nobody(shape, {constant(0), constant(0)}, kNoId, 1);
  CHECK(nobody.body_at({1, 1, 1}) == 0);
  // In front: beyond the box, the background, the larger number.
  CHECK(partition.in_order(0, 2) == std::array<BodyId, 2>{2, 0});
  CHECK(partition.in_order(1, 2) == std::array<BodyId, 2>{1, 2});
  CHECK(partition.in_order(1, partition.beyond(3)) == std::array<BodyId, 2>{6, 1});
}

TEST_CASE("a step leads to where fields are equal, and stays in a face of the box") {
  const Partition partition = balls();
  Vec3 p{15, 21, 15};
  const std::array<BodyId, 3> three{0, 1, 2};
  for (int n = 0; n < 5; ++n) p = p + *partition.step_to_tie(p, three, 0);
  CHECK(std::fabs(p.x - 15.5) < 0.05);
  CHECK(std::fabs(distance(p, kCenters[0]) - kRadius) < 0.15);
  const std::array<BodyId, 2> two{0, 1};
  const auto flat = partition.step_to_tie({6, 10, 9}, two, 1u << 3);
  REQUIRE(flat.has_value());
  CHECK(flat->y == 0);
  CHECK_FALSE(partition.step_to_tie({0, 0, 0}, two, 63).has_value());
}
