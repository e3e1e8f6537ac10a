// SPDX-License-Identifier: MIT
#include "coarsen/fans.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/triangle.h"

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

bool is_fan(const TriMesh& mesh) {
  IdArray<FaceId, Vec3> normals;
  for (const Face& face : mesh.faces) {
    const auto& [a, b, c] = face.v;
    normals.push_back(area_normal(mesh.points[a], mesh.points[b], mesh.points[c]));
  }
  return stars_that_are_fans(mesh, normals)[0] != 0;
}

}  // namespace

TEST_CASE("a closed star is a fan if its facets go around once, from wherever they begin") {
  for (double first = 0; first < 360; first += 15) {
    const auto from = [&](std::vector<double> turns) {
      for (double& turn : turns) turn += first;
      return turns;
    };
    CHECK(is_fan(star_of(from({0, 90, 180, 270}), {0, 0, 0, 0}, true)));
    CHECK(is_fan(star_of(from({0, 80, 160, 240, 320}), {0, .1, .3, .1, 0}, true)));
    // An open star, which may come back over its beginning.
    CHECK_FALSE(is_fan(star_of(from({0, 80, 160, 240, 320}), {0, 0, 0, 0, 0}, false)));
    // A facet that turns back over the one before.
    CHECK_FALSE(is_fan(star_of(from({0, 100, 70, 180, 270}), {0, 0, .1, 0, 0}, true)));
    // Twice around.
    CHECK_FALSE(is_fan(star_of(from({0, 120, 240, 360, 480, 600}), {0, 0, 0, .1, .1, .1}, true)));
  }
}

}  // namespace deliso
