// SPDX-License-Identifier: MIT
// Holes over a plane, where the filling is known.
#include "surface/hole.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "volume/sampled.h"

using namespace deliso;

namespace {

// {g = 0} is the plane z = 5.5, seen from above.
const Volume kPlane =
    sampled<float>({11, 11, 11}, {1, 1, 1}, [](int, int, int k) { return 5.5 - k; });

// Returns the ring of a vertex at this height over the plane, with its neighbors in it.
Ring ring_of(double height, const std::vector<Vec3>& neighbors) {
  std::vector<Vec3> points{{5, 5, 5.5 + height}};
  points.insert(points.end(), neighbors.begin(), neighbors.end());
  std::vector<Triangle> triangles;
  const auto n = static_cast<std::uint32_t>(neighbors.size());
  for (std::uint32_t k = 0; k < n; ++k) {
    triangles.push_back({VertexId(0), VertexId(k + 1), VertexId((k + 1) % n + 1)});
  }
  Ring ring;
  REQUIRE(ring.walk(make_tri_mesh(points, triangles), 0, 0, false));
  ring.project();
  return ring;
}

FacetTest test_with(double bound) {
  Parameters p{};
  p.r_min = 0.1;
  p.refinement[Criterion::r_over_l] = 2;
  return FacetTest(kPlane, 0, p, bound);
}

std::vector<Vec3> hexagon(double height = 0) {
  std::vector<Vec3> points;
  for (int k = 0; k < 6; ++k) {
    const double angle = k * std::numbers::pi / 3;
    points.push_back({5 + 2 * std::cos(angle), 5 + 2 * std::sin(angle), 5.5 + height});
  }
  return points;
}

}  // namespace

TEST_CASE("a vertex may go if it lies within the bound of the facets over its hole") {
  Hole hole;
  for (const double height : {-0.09, 0.0, 0.09}) {
    CHECK(hole.fill(ring_of(height, hexagon()), test_with(0.1)));
    CHECK(hole.size() == 4);
  }
  for (const double height : {-0.11, 0.11}) {
    CHECK_FALSE(hole.fill(ring_of(height, hexagon()), test_with(0.1)));
  }
}

TEST_CASE("facets that fill a hole have the surface within the bound") {
  Hole hole;
  for (const double height : {-0.09, 0.09}) {
    CHECK(hole.fill(ring_of(height, hexagon(height)), test_with(0.1)));
  }
  for (const double height : {-0.11, 0.11}) {
    CHECK_FALSE(hole.fill(ring_of(height, hexagon(height)), test_with(0.1)));
  }
}

TEST_CASE("a hole in a plane is filled by its Delaunay triangulation") {
  // A kite, whose short diagonal is the Delaunay edge: wherever the walk begins.
  std::vector<Vec3> kite{{8, 5, 5.5}, {5, 6.5, 5.5}, {2, 5, 5.5}, {5, 3.5, 5.5}};
  for (std::size_t turn = 0; turn < kite.size(); ++turn) {
    const Ring ring = ring_of(0, kite);
    Hole hole;
    REQUIRE(hole.fill(ring, test_with(0.1)));
    REQUIRE(hole.size() == 2);
    for (int n = 0; n < hole.size(); ++n) {
      int near = 0;
      for (const int corner : hole.facet(n).corner) near += ring.point[corner].x == 5;
      CHECK(near == 2);
    }
    std::rotate(kite.begin(), kite.begin() + 1, kite.end());
  }
}

TEST_CASE("where a filling fails, the facet that was tried last is the one that was refused") {
  // The vertex is too high over the facet of three neighbors; the fourth makes one elsewhere.
  const std::vector<Vec3> neighbors{{8, 4, 5.5}, {8, 8, 5.5}, {4, 5, 5.5}, {5, 2, 5.5}};
  const Ring ring = ring_of(1, neighbors);
  Hole hole;
  REQUIRE_FALSE(hole.fill(ring, test_with(0.1)));
  const auto& [a, b, c] = hole.tried();
  CHECK(distance2_to_triangle({5, 5, 5.5}, ring.point[a], ring.point[b], ring.point[c]) == 0);
}
