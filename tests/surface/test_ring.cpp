// SPDX-License-Identifier: MIT
#include "surface/ring.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace deliso {
namespace {

// Returns the star of vertex 0: facets from each neighbor to the next, `turns` in degrees from the
// x axis, at these heights. `closed`: and from the last to the first.
TriMesh star_of(const std::vector<double>& turns, const std::vector<double>& heights, bool closed) {
  std::vector<Vec3> points{{0, 0, 0}};
  for (std::size_t k = 0; k < turns.size(); ++k) {
    const double angle = turns[k] * std::numbers::pi / 180;
    points.push_back({std::cos(angle), std::sin(angle), heights[k]});
  }
  std::vector<Triangle> triangles;
  const auto n = static_cast<std::uint32_t>(turns.size());
  for (std::uint32_t k = 0; k + 1 < n + closed; ++k) {
    triangles.push_back({VertexId(0), VertexId(k + 1), VertexId((k + 1) % n + 1)});
  }
  return make_tri_mesh(points, triangles);
}

bool is_fan(const TriMesh& mesh, bool closed) {
  Ring ring;
  REQUIRE(ring.walk(mesh, 0, 0, !closed));
  ring.project();
  return ring.is_fan();
}

}  // namespace

TEST_CASE("a star is a fan if its facets go around once at most, from wherever they begin") {
  for (double first = 0; first < 360; first += 15) {
    const auto from = [&](std::vector<double> turns) {
      for (double& turn : turns) turn += first;
      return turns;
    };
    CHECK(is_fan(star_of(from({0, 90, 180, 270}), {0, 0, 0, 0}, true), true));
    CHECK(is_fan(star_of(from({0, 60, 120, 180}), {0, 0, 0, 0}, false), false));
    CHECK(is_fan(star_of(from({0, 80, 160, 240, 320}), {0, 0, 0, 0, 0}, false), false));
    // A ramp that comes back over its beginning, and cuts it.
    CHECK_FALSE(
        is_fan(star_of(from({0, 80, 160, 240, 320, 400}), {0, .1, .1, .1, .1, 0}, false), false));
    // A facet that turns back over the one before.
    CHECK_FALSE(is_fan(star_of(from({0, 100, 70, 180, 270}), {0, 0, .1, 0, 0}, true), true));
    // Twice around.
    CHECK_FALSE(
        is_fan(star_of(from({0, 120, 240, 360, 480, 600}), {0, 0, 0, .1, .1, .1}, true), true));
  }
}

}  // namespace deliso
