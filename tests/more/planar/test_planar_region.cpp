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

// Splits the sides that the refiner requests, in their middle, until it requests none. Shorter ones
// stay.
std::size_t refine(ConstrainedTriangulation& t, RegionRefiner& refiner, double shortest = 0) {
  std::size_t split = 0;
  while (true) {
    std::vector<std::pair<VertexId, VertexId>> sides;
    refiner.run(sides);
    if (sides.empty()) return split;
    for (const auto& [a, b] : sides) {
      if (distance2(t.point(a), t.point(b)) < shortest * shortest) {
        refiner.keep_side(a, b);
        continue;
      }
      refiner.add_split(t.split_edge(t.find_edge(a, b), 0.5 * (t.point(a) + t.point(b))));
      ++split;
    }
  }
}

std::size_t count_bad(const ConstrainedTriangulation& t, double lambda) {
  std::size_t bad = 0;
  for (const PlaneTriangle& at : t.triangles()) {
    if (!at.inside) continue;
    const double a = std::sqrt(distance2(t.point(at.v[1]), t.point(at.v[2])));
    const double b = std::sqrt(distance2(t.point(at.v[2]), t.point(at.v[0])));
    const double c = std::sqrt(distance2(t.point(at.v[0]), t.point(at.v[1])));
    bad += a * b * c / (2 * twice_area(t, at)) > (1 + 1e-9) * lambda * std::min({a, b, c});
  }
  return bad;
}

// Returns how many triangles of the inside have a corner from `first` on in the circle about a
// segment, or about a side of the rectangle.
std::size_t count_in_circles(const ConstrainedTriangulation& t, VertexId first,
                             bool about_segments) {
  std::size_t count = 0;
  for (const PlaneTriangle& at : t.triangles()) {
    for (int i = 0; i < 3; ++i) {
      if (!at.inside || at.v[i] < first) continue;
      if (about_segments ? at.side[i] == Side::none : at.n[i] != kNoId) continue;
      const Vec2 p = t.point(at.v[i]);
      count += dot(t.point(at.v[(i + 1) % 3]) - p, t.point(at.v[(i + 2) % 3]) - p) < 0;
    }
  }
  return count;
}

}  // namespace

TEST_CASE("the side of the segments decides, through nested loops and islands") {
  std::size_t bad = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    ConstrainedTriangulation t({-10, -10}, {10, 10});
    const auto outer = add_polygon(t, random, {0, 0}, 7, 9, 23);
    const auto hole = add_polygon(t, random, {0, 0}, 4, 6.9, 17);
    const auto island = add_polygon(t, random, {0, 0}, 1, 2, 11);
    bound(t, outer, true);
    bound(t, hole, false);
    bound(t, island, true);
    REQUIRE(mark_inside(t, seed % 2 == 0));
    const double expected = area_of(t, outer) - area_of(t, hole) + area_of(t, island);
    CHECK(area_inside(t) == doctest::Approx(expected).epsilon(1e-12));

    const VertexId first(t.points().size());
    RegionRefiner refiner(t, 1.2);
    refine(t, refiner);
    CHECK(count_in_circles(t, first, true) == 0);
    check_triangulation(t, 2 * 400);
    CHECK(area_inside(t) == doctest::Approx(expected).epsilon(1e-12));
    for (const auto& polygon : {outer, hole, island}) {
      for (std::size_t n = 0; n < polygon.size(); ++n) {
        const PlaneEdge e = t.find_edge(polygon[n], polygon[(n + 1) % polygon.size()]);
        REQUIRE(e.t != kNoId);
        CHECK(t.triangle(e.t).side[e.i] != Side::none);
      }
    }
    CHECK(count_bad(t, 1.2) <= refiner.refused());
    bad += count_bad(t, 1.2);
  }
  CHECK(bad > 0);
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
    CHECK(count_bad(t, std::sqrt(2)) == 0);
    CHECK(count_in_circles(t, VertexId(0), false) == 0);
    // Graded: far fewer triangles than the smallest edge would need everywhere.
    CHECK(t.points().size() < 110);
  }
  CHECK(split > 40);
}

TEST_CASE("sides that must stay are whole, and triangles that stay bad beside them are counted") {
  ConstrainedTriangulation t({0, 0}, {8, 1});
  Random random(1);
  bound(t, add_polygon(t, random, {4, 0.5}, 0.2, 0.4, 9), false);
  REQUIRE(mark_inside(t, true));
  RegionRefiner refiner(t, std::sqrt(2));
  CHECK(refine(t, refiner, 2) > 0);
  CHECK(t.find_edge(1, 2).t != kNoId);
  CHECK(count_bad(t, std::sqrt(2)) > 0);
  CHECK(count_bad(t, std::sqrt(2)) <= refiner.refused());
}
