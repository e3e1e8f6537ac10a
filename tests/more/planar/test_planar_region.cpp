// SPDX-License-Identifier: MIT
// Regions bounded by random closed polygons: which side is inside, and what refinement may do.
#include "more/planar/planar_region.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/random.h"
#include "more/planar/planar_checks.h"

using namespace deliso;

namespace {

// Adds a star-shaped polygon around a center, counter-clockwise, with this side on its left.
std::vector<VertexId> add_polygon(ConstrainedTriangulation& t, Random& random, Vec2 center,
                                  double lo, double hi, int corners) {
  std::vector<VertexId> polygon;
  for (int n = 0; n < corners; ++n) {
    const double angle = 6.283185307179586 * n / corners, r = random.uniform(lo, hi);
    polygon.push_back(t.insert({center.x + r * std::cos(angle), center.y + r * std::sin(angle)}));
  }
  return polygon;
}

void bound(ConstrainedTriangulation& t, const std::vector<VertexId>& polygon, bool inside) {
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    REQUIRE(t.constrain(polygon[n], polygon[(n + 1) % polygon.size()],
                        inside ? Side::inside : Side::outside,
                        inside ? Side::outside : Side::inside));
  }
}

double area_of(const ConstrainedTriangulation& t, const std::vector<VertexId>& polygon) {
  double sum = 0;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Vec2 &a = t.point(polygon[n]), &b = t.point(polygon[(n + 1) % polygon.size()]);
    sum += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return sum;
}

double area_inside(const ConstrainedTriangulation& t) {
  double sum = 0;
  for (const PlaneTriangle& at : t.triangles()) sum += at.inside ? 0.5 * twice_area(t, at) : 0;
  return sum;
}

// Splits the sides that the refiner requests, in their middle, until it requests none.
std::size_t refine(ConstrainedTriangulation& t, RegionRefiner& refiner) {
  std::size_t split = 0;
  while (true) {
    std::vector<std::pair<VertexId, VertexId>> sides;
    refiner.run(sides);
    if (sides.empty()) return split;
    for (const auto& [a, b] : sides) {
      refiner.add_split(t.split_edge(t.find_edge(a, b), 0.5 * (t.point(a) + t.point(b))));
      ++split;
    }
  }
}

double worst_ratio(const ConstrainedTriangulation& t) {
  double worst = 0;
  for (const PlaneTriangle& at : t.triangles()) {
    if (!at.inside) continue;
    const double a = std::sqrt(distance2(t.point(at.v[1]), t.point(at.v[2])));
    const double b = std::sqrt(distance2(t.point(at.v[2]), t.point(at.v[0])));
    const double c = std::sqrt(distance2(t.point(at.v[0]), t.point(at.v[1])));
    worst = std::max(worst, a * b * c / (2 * twice_area(t, at)) / std::min({a, b, c}));
  }
  return worst;
}

}  // namespace

TEST_CASE("the side of the segments decides, through nested loops and islands") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    ConstrainedTriangulation t({-10, -10}, {10, 10});
    const auto outer = add_polygon(t, random, {0, 0}, 7, 9, 23);
    const auto hole = add_polygon(t, random, {0, 0}, 4, 5, 17);
    const auto island = add_polygon(t, random, {0, 0}, 1, 2, 11);
    bound(t, outer, true);
    bound(t, hole, false);
    bound(t, island, true);
    REQUIRE(mark_inside(t, seed % 2 == 0));
    const double expected = area_of(t, outer) - area_of(t, hole) + area_of(t, island);
    CHECK(area_inside(t) == doctest::Approx(expected).epsilon(1e-12));

    RegionRefiner refiner(t, 2);
    refine(t, refiner);
    check_triangulation(t, 2 * 400);
    CHECK(area_inside(t) == doctest::Approx(expected).epsilon(1e-12));
    for (const auto& polygon : {outer, hole, island}) {
      for (std::size_t n = 0; n < polygon.size(); ++n) {
        CHECK(t.find_edge(polygon[n], polygon[(n + 1) % polygon.size()]).t != kNoId);
      }
    }
    if (refiner.refused() == 0) CHECK(worst_ratio(t) <= 2 * (1 + 1e-12));
  }
}

TEST_CASE("without a segment the default decides; contradictory segments are refused") {
  for (const bool inside : {true, false}) {
    ConstrainedTriangulation t({0, 0}, {4, 4});
    REQUIRE(mark_inside(t, inside));
    CHECK(area_inside(t) == (inside ? 16 : 0));
  }
  Random random(1);
  ConstrainedTriangulation t({-10, -10}, {10, 10});
  bound(t, add_polygon(t, random, {-5, 0}, 1, 2, 9), true);
  bound(t, add_polygon(t, random, {5, 0}, 1, 2, 9), false);
  CHECK_FALSE(mark_inside(t, false));
}

TEST_CASE("sides are split and circles filled until every triangle is well shaped") {
  int split = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    ConstrainedTriangulation t({-10, -10}, {10, 10});
    const double radius = random.uniform(0.1, 9.8);
    const auto hole = add_polygon(t, random, {0, 0}, radius, radius, 24);
    bound(t, hole, false);
    REQUIRE(mark_inside(t, true));
    RegionRefiner refiner(t, std::sqrt(2));
    split += static_cast<int>(refine(t, refiner));
    check_triangulation(t, 2 * 400);
    CHECK(refiner.refused() == 0);
    CHECK(worst_ratio(t) <= std::sqrt(2) * (1 + 1e-9));
    // Graded: far fewer triangles than the smallest edge would need everywhere.
    CHECK(t.points().size() < 600);
  }
  CHECK(split > 40);
}
