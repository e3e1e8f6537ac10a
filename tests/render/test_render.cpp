// SPDX-License-Identifier: MIT
// Whole pictures, against what a sphere must look like from anywhere.
#include "render/render.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "base/check.h"
#include "base/random.h"
#include "mesh/meshes.h"
#include "render/rasterize.h"

using namespace deliso;
using namespace deliso::test;

namespace {

constexpr Vec3 kCenter{5, -7, 3};
constexpr double kRadius = 2;

// An octahedron, each facet cut into four and its corners moved to the sphere, `levels` times.
TriMesh sphere(int levels) {
  std::vector<Vec3> points{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  Triangles triangles = octahedron();
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<VertexId, VertexId>, VertexId> middles;
    const auto middle = [&](VertexId a, VertexId b) {
      const auto [at, added] =
          middles.try_emplace(std::minmax(a, b), static_cast<VertexId>(points.size()));
      const Vec3 sum = points[a] + points[b];
      if (added) points.push_back(sum / length(sum));
      return at->second;
    };
    Triangles finer;
    for (const auto& [a, b, c] : triangles) {
      const VertexId ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = finer;
  }
  for (Vec3& p : points) p = kCenter + kRadius * p;
  return make_tri_mesh(points, triangles);
}

TriMesh turned_round(TriMesh mesh) {
  for (Face& face : mesh.faces) {
    std::swap(face.v[1], face.v[2]);
    std::swap(face.n[1], face.n[2]);
  }
  return mesh;
}

RenderOptions small_picture() {
  RenderOptions options;
  options.size = {160, 120};
  options.view = View{40, 20};
  options.edges = Edges::hidden;
  return options;
}

struct Tally {
  int background = 0, outside = 0, inside = 0, dark = 0;
};

// The palette's outside is more blue than red at any light, the inside more red than blue.
Tally tally(const Image& image) {
  Tally counts;
  for (const Rgb& p : image.pixels) {
    if (p == Rgb{255, 255, 255}) {
      ++counts.background;
    } else if (p.blue < 60 && p.red < 60) {
      ++counts.dark;
    } else {
      ++(p.blue > p.red ? counts.outside : counts.inside);
    }
  }
  return counts;
}

}  // namespace

TEST_CASE("the silhouette of a sphere is a disk of its radius, from everywhere") {
  const TriMesh mesh = sphere(5);
  const double disk = std::numbers::pi * kRadius * kRadius;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const View view{random.uniform(-360, 360), random.uniform(-90, 90)};
    const Camera camera = fit_camera(mesh, view, 1, {400, 300}, {});
    const ProjectedMesh projected = project(mesh, camera, 1, {});
    const std::vector<FaceId> seen = visible_faces(mesh, projected, 0, projected.rows);
    int covered = 0;
    const double radius = camera.scale * kRadius;
    for (int row = 0; row < projected.rows; ++row) {
      for (int column = 0; column < projected.columns; ++column) {
        const double x = column + 0.5 - 200, y = row + 0.5 - 150;
        const double from_middle = std::sqrt(x * x + y * y);
        const bool hit = seen[static_cast<std::size_t>(row * projected.columns + column)] != kNoId;
        covered += hit;
        if (from_middle < radius - 1) REQUIRE(hit);
        if (from_middle > radius + 1) REQUIRE_FALSE(hit);
      }
    }
    CHECK(covered / (camera.scale * camera.scale) == doctest::Approx(disk).epsilon(0.004));
    // The sphere fills the picture's height but for the margin.
    CHECK(2 * radius > 0.92 * 300);
    CHECK(2 * radius < 300);
  }
}

TEST_CASE("the camera's axes are orthonormal and see +z upwards") {
  const TriMesh mesh = sphere(1);
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const View view{random.uniform(-360, 360), random.uniform(-89, 89)};
    const Camera camera = fit_camera(mesh, view, 1, {100, 100}, {});
    CHECK(length(camera.right) == doctest::Approx(1));
    CHECK(length(camera.up) == doctest::Approx(1));
    CHECK(length(cross(camera.right, camera.up) - camera.back) < 1e-12);
    CHECK(camera.up.z > 0);
    CHECK(camera.project(kCenter + Vec3{0, 0, 1}).y < camera.project(kCenter).y);
    CHECK(camera.project(kCenter + camera.back).depth > camera.project(kCenter).depth);
  }
}

TEST_CASE("the outside has one color and the inside the other") {
  const TriMesh mesh = sphere(4);
  for (const Shading shading : {Shading::smooth, Shading::flat}) {
    RenderOptions options = small_picture();
    options.shading = shading;
    const Tally outside = tally(render(mesh, options));
    CHECK(outside.outside > 5000);
    CHECK(outside.inside == 0);
    const Tally inside = tally(render(turned_round(mesh), options));
    // At the rim, pixels of background and dark orange can be of any hue.
    CHECK(inside.inside > 5000);
    CHECK(inside.outside == 0);
    CHECK(inside.background == outside.background);
  }
}

TEST_CASE("clipped in halves, a sphere shows its inside to one eye and its outside to the other") {
  const TriMesh mesh = sphere(4);
  RenderOptions options = small_picture();
  options.clip = ClipPlane{{1, 0, 0}, kCenter.x};
  options.view = View{0, 0};
  const Tally open = tally(render(mesh, options));
  CHECK(open.inside > 5000);
  CHECK(open.outside == 0);
  options.view = View{180, 0};
  const Tally closed = tally(render(mesh, options));
  CHECK(closed.outside > 5000);
  CHECK(closed.inside == 0);
  // From the side it is half a disk, which is fitted into the picture.
  options.view = View{90, 0};
  const Camera camera = fit_camera(mesh, *options.view, 1, {400, 300}, options.clip);
  const ProjectedMesh projected = project(mesh, camera, 1, options.clip);
  int covered = 0;
  for (const FaceId f : visible_faces(mesh, projected, 0, projected.rows)) covered += f != kNoId;
  CHECK(covered / (camera.scale * camera.scale) ==
        doctest::Approx(0.5 * std::numbers::pi * kRadius * kRadius).epsilon(0.01));
}

TEST_CASE("edges are drawn on request and where there is room for them") {
  RenderOptions options = small_picture();
  for (const int levels : {2, 6}) {
    const TriMesh mesh = sphere(levels);
    options.edges = Edges::hidden;
    const Image without = render(mesh, options);
    options.edges = Edges::drawn;
    const Image with = render(mesh, options);
    options.edges = Edges::automatic;
    CHECK(with.pixels != without.pixels);
    CHECK(render(mesh, options).pixels == (levels == 2 ? with : without).pixels);
  }
}

TEST_CASE("the same mesh gives the same picture; a view that is not given is the best one") {
  const TriMesh mesh = sphere(3);
  RenderOptions options = small_picture();
  options.edges = Edges::drawn;
  CHECK(render(mesh, options).pixels == render(mesh, options).pixels);
  options.clip = ClipPlane{{0, 1, 0}, kCenter.y};
  options.view.reset();
  const Image chosen = render(mesh, options);
  options.view = best_view(mesh, options.size, options.clip);
  CHECK(render(mesh, options).pixels == chosen.pixels);
}

TEST_CASE("the best view of a plate is the one nearest to face on") {
  for (const double angle : {0.0, 45.0, 110.0, 250.0}) {
    const double c = std::cos(angle * std::numbers::pi / 180);
    const double s = std::sin(angle * std::numbers::pi / 180);
    const Vec3 along{-s, c, 0}, up{0, 0, 1};
    const TriMesh plate =
        make_tri_mesh({Vec3{}, along, along + up, up}, Triangles{{0, 1, 2}, {0, 2, 3}});
    const View view = best_view(plate, {160, 120}, {});
    const double turn = (view.azimuth - angle) * std::numbers::pi / 180;
    CHECK(std::abs(std::cos(turn)) > 0.8);
  }
}

TEST_CASE("nothing to draw is said, not drawn") {
  CHECK_THROWS_AS(render(TriMesh{}, small_picture()), InputError);
  RenderOptions options = small_picture();
  options.clip = ClipPlane{{0, 0, 1}, -100};
  CHECK_THROWS_AS(render(sphere(1), options), InputError);
  TriMesh huge = sphere(1);
  for (Vec3& p : huge.points) p = 1e300 * p;
  CHECK_THROWS_AS(render(huge, small_picture()), InputError);
}

TEST_CASE("a point, a line and facets seen edge on are drawn as nothing, without a fault") {
  const TriMesh point = make_tri_mesh({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, Triangles{{0, 1, 2}});
  const TriMesh line = make_tri_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, Triangles{{0, 1, 2}});
  RenderOptions options = small_picture();
  for (const TriMesh* mesh : {&point, &line}) {
    CHECK(tally(render(*mesh, options)).background == 160 * 120);
  }
}
