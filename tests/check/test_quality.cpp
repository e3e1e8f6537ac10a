// SPDX-License-Identifier: MIT
// Triangle shapes against formulas for special triangles and the law of cosines in long double.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "check/quality.h"
#include "mesh/meshes.h"

using namespace deliso;
using namespace deliso::test;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

MeshQuality quality_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  return measure_quality(make_tri_mesh({a, b, c}, Triangles{{0, 1, 2}}), 2, 0);
}

doctest::Approx near(double value) {
  return doctest::Approx(value).epsilon(1e-13);
}

}  // namespace

TEST_CASE("special triangles have the angles and radii of their formulas") {
  const double root3 = std::numbers::sqrt3;
  MeshQuality q = quality_of({0, 0, 0}, {1, 0, 0}, {0.5, root3 / 2, 0});
  CHECK(q.min_angle == near(60));
  CHECK(q.max_angle == near(60));
  CHECK(q.max_r_over_l == near(1 / root3));
  CHECK(q.angle_histogram[11] == 1);
  CHECK(q.area == near(root3 / 4));

  q = quality_of({0, 0, 0}, {3, 0, 0}, {0, 4, 0});
  CHECK(q.max_angle == near(90));
  CHECK(q.min_angle == near(std::atan(0.75) * 180 / std::numbers::pi));
  CHECK(q.max_radius == near(2.5));
  CHECK(q.max_r_over_l == near(2.5 / 3));
  CHECK(q.min_edge == 3);
  CHECK(q.max_edge == 5);
  CHECK(q.mean_edge == 4);
  CHECK(q.area == 6);
  CHECK(q.degenerate_faces == 0);
}

TEST_CASE("triangles without area are counted, with infinite r/l") {
  for (const Vec3& c : {Vec3{0.25, 0, 0}, Vec3{3, 0, 0}, Vec3{1, 0, 0}}) {
    const MeshQuality q = quality_of({0, 0, 0}, {1, 0, 0}, c);
    CHECK(q.degenerate_faces == 1);
    CHECK(q.max_r_over_l == kInfinity);
    CHECK(q.max_radius == kInfinity);
    CHECK(q.over_lambda == 1);
    CHECK(q.min_angle == 0);
    CHECK(q.area == 0);
  }
}

TEST_CASE("an empty mesh has a quality of zeros") {
  const MeshQuality q = measure_quality(mesh_of({}), 2, 0);
  CHECK(q.faces == 0);
  CHECK(q.min_angle == 0);
  CHECK(q.min_edge == 0);
}

TEST_CASE("random meshes have the quality that the law of cosines gives, facet by facet") {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    RandomMesh source(octahedron(), seed);
    for (int i = 0; i < 20; ++i) source.change();
    TriMesh mesh = source.mesh();
    Random& random = source.random();
    for (Vec3& p : mesh.points) p = {random.uniform(), random.uniform(), random.uniform()};
    const double lambda = random.uniform(0.6, 3), r_min = random.uniform(0, 0.6);
    const MeshQuality q = measure_quality(mesh, lambda, r_min);

    std::vector<double> ratios;
    double min_angle = 180, max_angle = 0, max_above = 0, edge_sum = 0, area = 0;
    std::size_t over = 0, over_above = 0, histogram[12] = {};
    for (const Face& face : mesh.faces) {
      long double e[3], angles[3];
      for (int i = 0; i < 3; ++i) {
        const Vec3 d = mesh.points[face.v[(i + 1) % 3]] - mesh.points[face.v[(i + 2) % 3]];
        e[i] = std::sqrt(static_cast<long double>(d.x) * d.x + static_cast<long double>(d.y) * d.y +
                         static_cast<long double>(d.z) * d.z);
        edge_sum += static_cast<double>(e[i]) / 2;  // closed: each edge has two facets
      }
      for (int i = 0; i < 3; ++i) {
        const long double b = e[(i + 1) % 3], c = e[(i + 2) % 3];
        angles[i] = std::acos((b * b + c * c - e[i] * e[i]) / (2 * b * c));
      }
      const long double sine = std::sin(angles[0]), r = e[0] / (2 * sine);
      const double ratio = static_cast<double>(r / std::min({e[0], e[1], e[2]}));
      const auto degrees = [](long double a) {
        return static_cast<double>(a * 180 / std::numbers::pi_v<long double>);
      };
      const double least = degrees(std::min({angles[0], angles[1], angles[2]}));
      min_angle = std::min(min_angle, least);
      max_angle = std::max(max_angle, degrees(std::max({angles[0], angles[1], angles[2]})));
      area += static_cast<double>(e[1] * e[2] * sine / 2);
      ++histogram[static_cast<int>(least / 5)];
      ratios.push_back(ratio);
      over += ratio > lambda;
      if (static_cast<double>(r) > r_min) {
        max_above = std::max(max_above, ratio);
        over_above += ratio > lambda;
      }
    }
    std::sort(ratios.begin(), ratios.end());
    const doctest::Approx expected = doctest::Approx(0).epsilon(1e-9);
    CHECK(q.faces == mesh.faces.size());
    CHECK(q.min_angle == expected(min_angle));
    CHECK(q.max_angle == expected(max_angle));
    CHECK(q.max_r_over_l == expected(ratios.back()));
    CHECK(q.max_r_over_l_above_r_min == expected(max_above));
    CHECK(q.over_lambda == over);
    CHECK(q.over_lambda_above_r_min == over_above);
    CHECK(q.area == expected(area));
    CHECK(q.mean_edge == expected(edge_sum / (1.5 * static_cast<double>(mesh.faces.size()))));
    for (int i = 0; i < 12; ++i) CHECK(q.angle_histogram[i] == histogram[i]);
    for (std::size_t i = 0; i < q.r_over_l_quantiles.size(); ++i) {
      // The definition: this share of the facets does not exceed it, and no smaller value has that
      // property.
      const double value = q.r_over_l_quantiles[i] * (1 + 1e-9);
      const double share = static_cast<double>(
          std::upper_bound(ratios.begin(), ratios.end(), value) - ratios.begin());
      const double wanted = MeshQuality::kQuantiles[i] * static_cast<double>(ratios.size());
      CHECK(share >= wanted);
      CHECK(share - 1 < wanted);
    }
  }
}

TEST_CASE("lambda bounds the smallest angle") {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto point = [&] { return Vec3{random.uniform(), random.uniform(), random.uniform()}; };
    const MeshQuality q = quality_of(point(), point(), point());
    const double bound = std::asin(1 / (2 * q.max_r_over_l)) * 180 / std::numbers::pi;
    CHECK(q.min_angle == doctest::Approx(bound).epsilon(1e-6));
  }
}

TEST_CASE("enclosed_volume is accurate for closed meshes, however small and far apart") {
  const TriMesh unit = mesh_of(tetrahedron());
  const double size = enclosed_volume(unit);
  REQUIRE(size != 0);
  for (const double scale : {1.0, 1e-3, 1e-9}) {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    for (int copy = 0; copy < 20; ++copy) {
      const auto first = VertexId(points.size());
      const Vec3 at{1.0 * copy, 2.0 * copy, -3.0 * copy};
      for (const Vec3& p : unit.points) points.push_back(at + scale * p);
      for (const Face& f : unit.faces) {
        triangles.push_back(triangle_of(first + f.v[0], first + f.v[1], first + f.v[2]));
      }
    }
    const double expected = 20 * size * scale * scale * scale;
    CHECK(enclosed_volume(make_tri_mesh(points, triangles)) ==
          doctest::Approx(expected).epsilon(1e-4));
    for (Triangle& t : triangles) std::swap(t[0], t[1]);
    CHECK(enclosed_volume(make_tri_mesh(points, triangles)) ==
          doctest::Approx(-expected).epsilon(1e-4));
  }
}
