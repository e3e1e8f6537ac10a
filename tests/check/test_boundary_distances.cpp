// SPDX-License-Identifier: MIT
// Boundary edges against circles of known sagitta, and along the curves that the stages follow.
#include "check/distances.h"

#include <doctest/doctest.h>

#include <cmath>

#include "check/quality.h"
#include "deliso/mesh_isosurface.h"
#include "fields.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

constexpr double kPi = 3.14159265358979323846;

// A cylinder around the z axis of a 65 x 65 x 9 box, inside within `radius`.
Volume cylinder(double radius) {
  return sampled<float>({65, 65, 9}, {1, 1, 1}, [&](int i, int j, int) {
    const double x = i - 32, y = j - 32;
    return radius - std::sqrt(x * x + y * y);
  });
}

// A prism of n sides inscribed into it, with its corners on the curve of the samples.
CleanMesh prism(const Isosurface& surface, int n) {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  for (const double z : {0.0, 8.0}) {
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * kPi * k / n;
      const Vec3 direction{std::cos(angle), std::sin(angle), 0};
      SearchCounters counters;
      const auto hit = surface.nearest(Vec3{32, 32, z} + 20 * direction, direction, 2, counters);
      REQUIRE(hit);
      points.push_back(hit->point);
    }
  }
  for (VertexId k = 0; k < VertexId(n); ++k) {
    const VertexId a(k), b((k + 1) % n), c(a + n), d(b + n);
    triangles.push_back({a, b, d});
    triangles.push_back({a, d, c});
  }
  Faults faults;
  const CleanMesh mesh = check_validity(make_tri_mesh(points, triangles), surface.volume().box(),
                                        MayEnd::on_box, faults);
  CHECK_FALSE(faults.any());
  return mesh;
}

}  // namespace

TEST_CASE("h of polygons inscribed into a circle is their sagitta") {
  const Volume volume = cylinder(20);
  const Isosurface surface(volume, geometric_isovalue(volume.type(), 0));
  for (const int n : {5, 8, 13, 24}) {
    CAPTURE(n);
    const CleanMesh mesh = prism(surface, n);
    const double expected = std::tan(kPi / n / 2);
    const double h = 20 * (1 - std::cos(kPi / n));
    const auto measured = [&](double distance, double h_over_r, double r_min) {
      Criteria limits;
      limits[Criterion::distance] = distance;
      limits[Criterion::h_over_r] = h_over_r;
      limits.r_min = r_min;
      const BoundaryDistances d = boundary_distances(mesh, surface, limits);
      CHECK(d.edges == std::size_t(2 * n));
      CHECK(d.max_h == doctest::Approx(h).epsilon(0.03));
      return d.over_a_limit;
    };
    CHECK(measured(kNotAsked, 0.1, 0) == (expected > 0.1 ? std::size_t(2 * n) : 0));
    CHECK(measured(0.3, kNotAsked, 0) == (h > 0.3 ? std::size_t(2 * n) : 0));
    CHECK(measured(0.97 * h, kNotAsked, 0) == std::size_t(2 * n));
    CHECK(measured(kNotAsked, 0.97 * expected, 0) == std::size_t(2 * n));
    CHECK(measured(1.03 * h, 1.03 * expected, 0) == 0);
    // No limits, or no edge large enough for them.
    CHECK(measured(kNotAsked, kNotAsked, 0) == 0);
    CHECK(measured(0.3, 0.1, 20) == 0);
  }
}

TEST_CASE("the stages follow the curves on the box, without slivers along them") {
  int edges = 0;
  for (int n = 0; n < 5; ++n) {
    CAPTURE(n);
    const Scene scene = n == 0   ? builtin_scene("gyroid", 32)
                        : n == 1 ? builtin_scene("fuel", 32)
                                 : wave_scene(static_cast<std::uint64_t>(n), 16);
    Options options = paper_criteria();
    options.r_min = {0.05, Length::Unit::voxel};
    Report report;
    const TriMesh mesh = mesh_isosurface(scene.volume, scene.surface.kappa(), options, report);
    Faults faults;
    const CleanMesh clean = check_validity(mesh, scene.volume.box(), MayEnd::on_box, faults);
    Criteria limits;
    limits[Criterion::distance] = options.limits[Criterion::distance].in(scene.volume);
    limits[Criterion::r_over_l] = options.limits[Criterion::r_over_l].value;
    limits.r_min = report.r_min;
    const BoundaryDistances d = boundary_distances(clean, scene.surface, limits);
    edges += static_cast<int>(d.edges);
    CHECK(100 * d.over_a_limit <= d.edges);
    std::vector<Triangle> along;
    for (const CleanMesh::End& end : clean.ends) {
      const Triangle& t = clean.triangles[end.triangle];
      if (along.empty() || along.back() != t) along.push_back(t);
    }
    const MeshQuality q = measure_quality(make_tri_mesh(mesh.points, along), 2, 0);
    CHECK(100 * (q.angle_histogram[0] + q.angle_histogram[1]) <= along.size());
  }
  CHECK(edges > 500);
}
