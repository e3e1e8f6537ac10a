// SPDX-License-Identifier: MIT
// The sky seen from bodies whose share of it is known.
#include "view/render/occlusion.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "mesh/meshes.h"
#include "view/render/shade.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// A closed body of revolution: a torus of radii 3 and 1 as a grid.
TriMesh torus() {
  constexpr std::uint32_t kAround = 48, kAcross = 24;
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i < kAround; ++i) {
    for (std::uint32_t j = 0; j < kAcross; ++j) {
      const double u = 2 * 3.14159265358979 * i / kAround, v = 2 * 3.14159265358979 * j / kAcross;
      const double r = 3 + std::cos(v);
      points.push_back({r * std::cos(u), r * std::sin(u), std::sin(v)});
    }
  }
  return make_tri_mesh(points, torus_grid(kAround, kAcross));
}

// Two square plates, `gap` apart, whose normals point upwards.
TriMesh plates(double gap) {
  std::vector<Vec3> points;
  Triangles triangles;
  constexpr std::uint32_t kSide = 20;
  for (const double z : {0.0, gap}) {
    const auto first = static_cast<std::uint32_t>(points.size());
    for (std::uint32_t j = 0; j <= kSide; ++j) {
      for (std::uint32_t i = 0; i <= kSide; ++i) points.push_back({double(i), double(j), z});
    }
    for (std::uint32_t j = 0; j < kSide; ++j) {
      for (std::uint32_t i = 0; i < kSide; ++i) {
        const std::uint32_t a = first + j * (kSide + 1) + i, b = a + kSide + 1;
        triangles.push_back(triangle_of(a, a + 1, b));
        triangles.push_back(triangle_of(a + 1, b + 1, b));
      }
    }
  }
  return make_tri_mesh(points, triangles);
}

std::vector<SkySeen> sky_of(const Subject& subject, int threads = 1) {
  return find_sky(subject, vertex_normals(*subject.mesh), threads);
}

}  // namespace

TEST_CASE("the outside of a torus sees the sky, its hole less, its inside nothing") {
  const TriMesh mesh = torus();
  const double turn = dot(vertex_normals(mesh)[0], Vec3{1, 0, 0});
  const auto sky = sky_of({&mesh, {}});
  REQUIRE(std::abs(turn) > 0.9);
  for (std::size_t v = 0; v < sky.size(); ++v) {
    const float outer = turn > 0 ? sky[v].outside : sky[v].inside;
    const float inner = turn > 0 ? sky[v].inside : sky[v].outside;
    const double r = std::hypot(mesh.points[VertexId(v)].x, mesh.points[VertexId(v)].y);
    CAPTURE(r);
    CHECK(inner < 0.1f);
    if (r > 3.5) CHECK(outer > 0.97f);
    if (r < 2.05) CHECK(outer < 0.8f);
    if (r < 2.05) CHECK(outer > 0.2f);
  }
}

TEST_CASE("between two plates it is the darker the closer they are") {
  const std::size_t middle = 10 * 21 + 10, above = middle + 21 * 21;
  float last = -1;
  for (const double gap : {1.0, 4.0, 12.0, 40.0}) {
    CAPTURE(gap);
    const TriMesh mesh = plates(gap);
    const auto sky = sky_of({&mesh, {}});
    // A square of half side 10 at the height `gap` hides this share, by its form factor.
    const double x = 10 / gap, root = std::sqrt(1 + x * x);
    const double hidden = 4 / 3.14159265358979 * x / root * std::atan(x / root);
    CHECK(sky[middle].outside == doctest::Approx(1 - hidden).epsilon(0.06).scale(1));
    CHECK(sky[middle].outside > last);
    last = sky[middle].outside;
    CHECK(sky[middle].inside > 0.97f);
    CHECK(sky[above].outside > 0.97f);
  }
}

TEST_CASE("what is clipped hides nothing, and threads change nothing") {
  const TriMesh mesh = plates(1);
  const std::size_t middle = 10 * 21 + 10;
  CHECK(sky_of({&mesh, {}})[middle].outside < 0.1f);
  CHECK(sky_of({&mesh, ClipPlane{{0, 0, 1}, 0.5}})[middle].outside > 0.97f);
  const auto one = sky_of({&mesh, {}}), three = sky_of({&mesh, {}}, 3);
  for (std::size_t v = 0; v < one.size(); ++v) {
    REQUIRE(one[v].outside == three[v].outside);
    REQUIRE(one[v].inside == three[v].inside);
  }
}
