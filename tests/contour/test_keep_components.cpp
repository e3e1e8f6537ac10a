// SPDX-License-Identifier: MIT
#include "contour/contour.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "base/random.h"
#include "deliso/fields.h"

using namespace deliso;

namespace {

// The places of all triangles' corners, then of all chains, of the selected components.
std::vector<Vec3> places(const ContourMesh& contour, const std::vector<std::uint8_t>& selected) {
  std::vector<Vec3> all;
  for (const auto& t : contour.triangles) {
    if (!selected[contour.component[t[0]]]) continue;
    for (const VertexId v : t) all.push_back(contour.points[v]);
  }
  for (std::size_t c = 0; c < contour.boundary.size(); ++c) {
    if (!selected[contour.boundary.component[c]]) continue;
    for (const VertexId v : contour.boundary.vertices[c]) all.push_back(contour.points[v]);
  }
  return all;
}

}  // namespace

TEST_CASE("what is kept of a contour is as it was, and nothing else is there") {
  Random random(5);
  std::size_t left_out = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    CAPTURE(seed);
    const Scene scene = wave_scene(seed, 20);
    ContourMesh contour = scene.contour;
    const std::vector<ContourComponent>& all = scene.contour.summary.components;
    std::vector<std::uint8_t> kept;
    std::vector<ContourComponent> expected;
    for (const ContourComponent& c : all) {
      kept.push_back(random.below(2) == 0);
      if (kept.back() != 0) expected.push_back(c);
    }
    left_out += all.size() - expected.size();
    keep_components(contour, kept);

    CHECK(contour.summary.components == expected);
    const std::vector<std::uint8_t> every(expected.size(), 1);
    CHECK(places(contour, every) == places(scene.contour, kept));
    CHECK(contour.component.size() == contour.points.size());
    CHECK(contour.box_faces.size() == contour.points.size());
    std::vector<std::uint64_t> loops(expected.size(), 0);
    for (std::size_t c = 0; c < contour.boundary.size(); ++c) {
      ++loops[contour.boundary.component[c]];
      for (const VertexId v : contour.boundary.vertices[c]) {
        CHECK(contour.on_boundary(v));
        CHECK(contour.component[v] == contour.boundary.component[c]);
      }
    }
    std::vector<std::uint8_t> is_used(contour.points.size(), 0);
    for (const auto& t : contour.triangles) {
      for (const VertexId v : t) {
        is_used[v] = 1;
        CHECK(contour.component[v] == contour.component[t[0]]);
      }
    }
    CHECK(std::ranges::count(is_used, 0) == 0);
    for (std::size_t c = 0; c < expected.size(); ++c) CHECK(loops[c] == expected[c].boundary_loops);
  }
  CHECK(left_out > 5);
}
