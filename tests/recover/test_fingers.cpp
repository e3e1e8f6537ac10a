// SPDX-License-Identifier: MIT
// No vertex of T is left further from K than --fingers allows, by brute force.
#include "recover/fingers.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "base/triangle.h"
#include "deliso/fields.h"
#include "deliso/options.h"
#include "recover/recover_certified.h"

using namespace deliso;

namespace {

// A ball with a rod of a radius below a voxel: a branch that one region can hold.
Scene ball_with_a_rod() {
  constexpr int kSize = 24;
  std::vector<float> samples;
  for (int k = 0; k < kSize; ++k) {
    for (int j = 0; j < kSize; ++j) {
      for (int i = 0; i < kSize; ++i) {
        const double ball = 4.6 - std::sqrt((i - 6.1) * (i - 6.1) + (j - 11.7) * (j - 11.7) +
                                            (k - 12.2) * (k - 12.2));
        const double beyond = std::max({0.0, i - 14.8, 6.1 - i});
        const double rod =
            0.9 - std::sqrt((j - 11.7) * (j - 11.7) + (k - 12.2) * (k - 12.2) + beyond * beyond);
        samples.push_back(static_cast<float>(std::max(ball, rod)));
      }
    }
  }
  return Scene(Volume::from_samples({kSize, kSize, kSize}, {1, 1, 1}, samples), 0);
}

double furthest_from_k(const Scene& scene, double fingers) {
  Options options;
  options.fingers = {fingers, Length::Unit::voxel};
  Report report;
  const Parameters parameters = resolve(options, scene.volume);
  const Recovered k =
      recover_certified(scene.surface, ContourMesh(scene.contour), parameters, report);
  double furthest2 = 0;
  for (const Vec3& p : k.witnesses) {
    double nearest2 = std::numeric_limits<double>::infinity();
    for (const Face& face : k.mesh.mesh.faces) {
      const auto at = [&](std::size_t i) { return k.mesh.mesh.points[face.v[i]]; };
      nearest2 = std::min(nearest2, distance2_to_triangle(p, at(0), at(1), at(2)));
    }
    furthest2 = std::max(furthest2, nearest2);
  }
  return std::sqrt(furthest2);
}

}  // namespace

TEST_CASE("no vertex of T is further from K than the limit for fingers") {
  for (const char* name : {"five_spheres", "gyroid", "machine"}) {
    CAPTURE(name);
    const Scene scene = builtin_scene(name, 20);
    for (const double limit : {2.0, 1.0, 0.5}) {
      CAPTURE(limit);
      CHECK(furthest_from_k(scene, limit) <= limit);
    }
  }
}

TEST_CASE("a rod is a disk to the certificate, and a finger to the search for fingers") {
  const Scene scene = ball_with_a_rod();
  CHECK(furthest_from_k(scene, Options::kNone) > 1);
  CHECK(furthest_from_k(scene, 0.5) <= 0.5);
}
