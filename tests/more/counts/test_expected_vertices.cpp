// SPDX-License-Identifier: MIT
// The estimate against what meshing gives, and against areas that are known.
#include "more/counts/expected_vertices.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "contour/contour.h"
#include "deliso/mesh_isosurface.h"
#include "fields.h"
#include "io/volume/builtin_volume.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

struct MeshedField {
  explicit MeshedField(const std::string& name)
      : volume(make_builtin_volume("builtin:" + name)),
        kappa(find_builtin_field("builtin:" + name)->isovalue) {}
  Volume volume;
  double kappa;
};

constexpr double kPi = 3.14159265358979323846;

// Inside within `radius` of the middle of a box with `side` to either side of it.
Volume ball(double radius, Vec3 spacing, double side) {
  const Index3 dims{static_cast<int>(2 * side / spacing.x) + 1,
                    static_cast<int>(2 * side / spacing.y) + 1,
                    static_cast<int>(2 * side / spacing.z) + 1};
  return sampled<float>(dims, spacing, [&](int i, int j, int k) {
    const Vec3 p = Vec3{i * spacing.x, j * spacing.y, k * spacing.z} - Vec3{side, side, side};
    return radius - length(p);
  });
}

struct Found {
  double expected, made;

  double ratio() const { return expected / made; }
};
struct OfStages {
  Found stage1, mesh;
};

// Meshes the field, and estimates the mesh and what Stage 1 alone makes of it.
OfStages of_stages(const MeshedField& field, Options options) {
  options.block_side = 0;  // one block: no vertices are left for seams
  Report report;
  const TriMesh mesh = mesh_isosurface(field.volume, field.kappa, options, report);
  OfStages found;
  found.mesh = {expected_vertices(field.volume, field.kappa, options), double(mesh.points.size())};
  options.stop_after_stage1 = true;
  found.stage1 = {expected_vertices(field.volume, field.kappa, options),
                  double(report.vertices_coarsened)};
  return found;
}

}  // namespace

TEST_CASE("if every sample is read, the crossings are those of T") {
  for (const std::string name :
       {"sphere", "gyroid", "fuel", "noise", "marschner_lobb", "machine"}) {
    CAPTURE(name);
    const MeshedField field(name);
    std::uint64_t crossings = 0;
    for (const auto& c : summarize_contour(field.volume, field.kappa).components) {
      crossings += c.crossings;
    }
    REQUIRE(crossings > 1000);
    CHECK(estimate_surface(field.volume, field.kappa).crossings == double(crossings));
  }
}

TEST_CASE("the area of balls, whatever the shape of voxels and however many slices are left out") {
  const auto check_ball = [](double radius, Vec3 spacing, double side, double within) {
    CAPTURE(spacing.z);
    const double voxel = std::cbrt(spacing.x * spacing.y * spacing.z);
    const double exact = 4 * kPi * radius * radius / (voxel * voxel);
    const double area = estimate_surface(ball(radius, spacing, side), 0).area;
    CHECK(area == doctest::Approx(exact).epsilon(within));
  };
  check_ball(20, {1, 1, 1}, 24, 0.02);
  check_ball(20, {1, 1, 4}, 24, 0.05);
  check_ball(20, {0.5, 2, 1}, 24, 0.05);
  check_ball(110, {1, 1, 1}, 120, 0.05);  // 241^3: a third of the slices
}

TEST_CASE("by distance the estimate is within a factor of 3 of the mesh, and of Stage 1's") {
  int cases = 0;
  for (const std::string name :
       {"sphere", "torus", "linked_tori", "five_spheres", "gyroid", "orbital", "fuel", "machine"}) {
    const MeshedField field(name);
    for (const double d : {1.0, 0.3, 0.1, 0.03}) {
      for (const double r_min : {0.5, 1.0}) {
        CAPTURE(name);
        CAPTURE(d);
        CAPTURE(r_min);
        Options options;
        options.limits[Criterion::distance] = {d, Length::Unit::voxel};
        options.r_min = {r_min, Length::Unit::voxel};
        const OfStages found = of_stages(field, options);
        for (const double ratio : {found.mesh.ratio(), found.stage1.ratio()}) {
          CHECK(ratio > 1.0 / 3);
          CHECK(ratio < 3);
        }
        ++cases;
      }
    }
  }
  CHECK(cases == 64);
}

TEST_CASE("for noise the estimate is within 30 % of the mesh, and of Stage 1's") {
  const MeshedField field("noise:32");
  for (const double d : {1.0, 0.3, 0.1}) {
    CAPTURE(d);
    Options options;
    options.limits[Criterion::distance] = {d, Length::Unit::voxel};
    const OfStages found = of_stages(field, options);
    CHECK(found.mesh.ratio() == doctest::Approx(1).epsilon(0.3));
    CHECK(found.stage1.ratio() == doctest::Approx(1).epsilon(0.3));
  }
}

TEST_CASE("what each criterion and limit does to the estimate") {
  const MeshedField field("fuel");
  const auto expected = [&](const Options& options) {
    return expected_vertices(field.volume, field.kappa, options);
  };
  const Options plain;
  Options finer = plain;
  finer.limits[Criterion::distance].value /= 4;
  CHECK(expected(finer) > 2 * expected(plain));
  Options coarser = plain;
  coarser.r_min.value = 4;
  CHECK(expected(coarser) < expected(plain) / 2);
  Options small = plain;
  small.limits[Criterion::radius] = {0.5};
  CHECK(expected(small) > 1.5 * expected(plain));
  CHECK(expected(paper_criteria()) > expected(plain));

  Options counted = plain;
  counted.target_vertices = 1000;
  CHECK(expected(counted) == 1000);
  counted.target_triangles = 1000;
  CHECK(expected(counted) == 500);
  counted.target_triangles = Options::kNoTarget;
  counted.target_vertices = 1000000000;  // more than r_min has room for
  CHECK(expected(counted) < 1e6);
  Options kept = plain;
  kept.max_vertices = 500;
  CHECK(expected(kept) == expected(plain));  // it would end in an error
  Options stage1 = plain;
  stage1.stop_after_stage1 = true;
  stage1.limits[Criterion::distance].value = 1e-6;  // T itself, which has 1.5 vertices per area
  CHECK(expected(stage1) == estimate_surface(field.volume, field.kappa).crossings);
  CHECK(expected_vertices(field.volume, 1e9, plain) == 0);
}
