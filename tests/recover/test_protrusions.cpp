// SPDX-License-Identifier: MIT
// No vertex of T is left further from K than --fingers allows, or is not faced, by brute force.
#include "recover/protrusions.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "base/triangle.h"
#include "delaunay/predicates.h"
#include "deliso/deliso.h"
#include "deliso/fields.h"
#include "deliso/options.h"
#include "stress/tiny_volume.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

// A ball with a rod of a radius below a voxel: a branch that one region can hold.
Scene ball_with_a_rod() {
  constexpr int kSize = 24;
  std::vector<float> samples;
  for_each_index({kSize, kSize, kSize}, [&](int i, int j, int k) {
    const double ball =
        4.6 - std::sqrt((i - 6.1) * (i - 6.1) + (j - 11.7) * (j - 11.7) + (k - 12.2) * (k - 12.2));
    const double beyond = std::max({0.0, i - 14.8, 6.1 - i});
    const double rod =
        0.9 - std::sqrt((j - 11.7) * (j - 11.7) + (k - 12.2) * (k - 12.2) + beyond * beyond);
    samples.push_back(static_cast<float>(std::max(ball, rod)));
  });
  return Scene(Volume::from_samples({kSize, kSize, kSize}, {1, 1, 1}, samples), 0);
}

struct Seen {
  double furthest = 0;        // vertex of T from K
  std::size_t not_faced = 0;  // vertices of T beyond `near` that no facet within `fingers` faces
};

Seen look(const Scene& scene, double fingers, double near, std::uint64_t seed = 1) {
  Options options;
  options.seed = seed;
  options.fingers = {fingers, Length::Unit::voxel};
  Report report;
  const Parameters parameters = resolve(options, scene.volume);
  const DelaunayMesh k =
      delaunay_mesh(scene.surface, ContourMesh(scene.contour), stage1_only(), parameters, report);
  Seen seen;
  for (const Vec3& p : k.samples) {
    const Vec3 gradient = scene.surface.gradient(p);
    double nearest2 = std::numeric_limits<double>::infinity();
    bool is_faced = false;
    for (const Face& face : k.mesh.mesh.faces) {
      const auto at = [&](std::size_t i) { return k.mesh.mesh.points[face.v[i]]; };
      const double d2 = distance2_to_triangle(p, at(0), at(1), at(2));
      const Vec3 normal = area_normal(at(0), at(1), at(2));
      nearest2 = std::min(nearest2, d2);
      is_faced |= d2 <= fingers * fingers &&
                  -dot(normal, gradient) > 0.69 * length(normal) * length(gradient);
    }
    seen.furthest = std::max(seen.furthest, std::sqrt(nearest2));
    seen.not_faced += nearest2 > near * near && !is_faced;
  }
  return seen;
}

}  // namespace

// Three sites along the straight boundary of a plateau, or within a voxel's face, and no vertex of
// T that is far from them.
TEST_CASE("no facet of K has its corners on one line, nor an area that rounds to 0") {
  for (const std::uint64_t seed : {72, 261, 765, 1255, 1411, 1424, 2873, 2900, 2907, 5113, 6922}) {
    CAPTURE(seed);
    const stress::TinyVolume tiny = stress::make_tiny_volume(seed);
    Report report;
    const Scene scene(tiny.volume, tiny.isovalue);
    const DelaunayMesh k = delaunay_mesh(scene.surface, ContourMesh(scene.contour), stage1_only(),
                                         resolve(Options(), scene.volume), report);
    for (const Face& face : k.mesh.mesh.faces) {
      const auto at = [&](std::size_t i) { return k.mesh.mesh.points[face.v[i]]; };
      CHECK_FALSE(collinear(at(0), at(1), at(2)));
      CHECK(length2(area_normal(at(0), at(1), at(2))) > 0);
    }
  }
}

TEST_CASE(
    "no vertex of T is further from K than the limit, or than a fifth of a voxel where none "
    "faces it") {
  for (const char* name : {"five_spheres", "gyroid", "machine"}) {
    CAPTURE(name);
    const Scene scene = builtin_scene(name, 20);
    for (const double limit : {2.0, 1.0, 0.5}) {
      CAPTURE(limit);
      const Seen seen = look(scene, limit, 0.2);
      CHECK(seen.furthest <= limit);
      CHECK(seen.not_faced == 0);
    }
  }
}

TEST_CASE("a thin branch is a disk to the certificate, and a protrusion to the search") {
  const Scene scene = ball_with_a_rod();
  int missed = 0;  // of first samples, those without a site near its tip
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    missed += look(scene, Options::kNone, 0.2, seed).furthest > 1;
    CHECK(look(scene, 0.5, 0.2, seed).furthest <= 0.5);
  }
  CHECK(missed >= 2);
}
