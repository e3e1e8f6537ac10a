// SPDX-License-Identifier: MIT
#include "contour/block_order.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <tuple>

#include "base/random.h"
#include "contour/contour.h"

using namespace deliso;

namespace {

auto key(const Vec3& p) {
  return std::tuple(p.x, p.y, p.z);
}

// The triangles as positions, each from its smallest corner on, sorted.
std::vector<std::array<std::tuple<double, double, double>, 3>> positions(const ContourMesh& t) {
  std::vector<std::array<std::tuple<double, double, double>, 3>> all;
  for (const auto& v : t.triangles) {
    std::array corners{key(t.points[v[0]]), key(t.points[v[1]]), key(t.points[v[2]])};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.push_back(corners);
  }
  std::sort(all.begin(), all.end());
  return all;
}

int block_of(const Volume& volume, const Vec3& p) {
  const Index3 v = volume.voxel_at(p);
  return v.i / 8 + 100 * (v.j / 8) + 10000 * (v.k / 8);
}

}  // namespace

TEST_CASE("the contour is the same but for its order, and blocks ascend") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Index3 dims{9 + static_cast<int>(random.below(20)),
                      9 + static_cast<int>(random.below(20)),
                      9 + static_cast<int>(random.below(20))};
    std::vector<float> samples(static_cast<std::size_t>(dims.i * dims.j * dims.k));
    for (float& s : samples) s = static_cast<float>(random.uniform());
    const Volume volume = Volume::from_samples(dims, {1, 1, 2}, samples);
    const ContourMesh before = build_contour(volume, 0.7);
    ContourMesh after = before;
    order_by_blocks(after, volume);

    CHECK(after.summary == before.summary);
    CHECK(positions(after) == positions(before));
    for (VertexId v = 1; v < after.points.size(); ++v) {
      CHECK(block_of(volume, after.points[v - 1]) <= block_of(volume, after.points[v]));
    }
    REQUIRE(after.boundary.vertices.size() == before.boundary.vertices.size());
    for (std::size_t k = 0; k < before.boundary.vertices.size(); ++k) {
      const VertexId a = after.boundary.vertices[k], b = before.boundary.vertices[k];
      CHECK(after.points[a] == before.points[b]);
      CHECK(after.box_faces[a] == before.box_faces[b]);
      CHECK(after.component[a] == before.component[b]);
    }
  }
}
