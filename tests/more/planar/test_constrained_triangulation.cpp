// SPDX-License-Identifier: MIT
// Constrained triangulations of random points and segments against brute force, on grids too,
// where most points are collinear or cocircular with others.
#include "more/planar/constrained_triangulation.h"

#include <doctest/doctest.h>

#include "base/random.h"
#include "more/planar/planar_checks.h"

using namespace deliso;

namespace {

using Segment2 = std::pair<VertexId, VertexId>;

bool on_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  return orient2d(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
         std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
}

bool cross_inside(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return orient2d(a, b, c) * orient2d(a, b, d) < 0 && orient2d(c, d, a) * orient2d(c, d, b) < 0;
}

// True if the segment passes a vertex, or crosses a segment that is there.
bool is_obstructed(const ConstrainedTriangulation& t, Segment2 s,
                   const std::vector<Segment2>& all) {
  const Vec2 &a = t.point(s.first), &b = t.point(s.second);
  for (VertexId v = 0; v < t.points().size(); ++v) {
    if (v != s.first && v != s.second && on_segment(t.point(v), a, b)) return true;
  }
  return std::any_of(all.begin(), all.end(), [&](Segment2 o) {
    return cross_inside(a, b, t.point(o.first), t.point(o.second));
  });
}

}  // namespace

TEST_CASE("every point and every segment without an obstacle is there, and the rest is Delaunay") {
  int segments = 0, obstructed = 0, duplicates = 0;
  for (std::uint64_t seed = 1; seed <= 250; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const bool grid = seed % 2 == 0;
    const Vec2 lo{-3, 1}, hi{13, 17};
    ConstrainedTriangulation t(lo, hi);
    const int count = 3 + static_cast<int>(random.below(60));
    for (int n = 0; n < count; ++n) {
      Vec2 p{random.uniform(lo.x, hi.x), random.uniform(lo.y, hi.y)};
      if (grid) p = {lo.x + random.below(17), lo.y + random.below(17)};
      if (random.below(6) == 0) (random.below(2) ? p.x : p.y) = random.below(2) ? lo.y : lo.x;
      p = {std::clamp(p.x, lo.x, hi.x), std::clamp(p.y, lo.y, hi.y)};
      const std::size_t before = t.points().size();
      const VertexId v = t.insert(p);
      CHECK(t.point(v) == p);
      duplicates += v < before;
    }
    check_triangulation(t, 2 * 16 * 16);
    // Without segments the whole is Delaunay: no vertex in any circle.
    for (const PlaneTriangle& at : t.triangles()) {
      for (const Vec2& p : t.points()) {
        REQUIRE(incircle(t.point(at.v[0]), t.point(at.v[1]), t.point(at.v[2]), p) <= 0);
      }
    }
    std::vector<Segment2> done;
    const auto vertices = static_cast<std::uint32_t>(t.points().size());
    for (int n = 0; n < 40; ++n) {
      const Segment2 s{random.below(vertices), random.below(vertices)};
      if (s.first == s.second) continue;
      const bool expected = is_obstructed(t, s, done);
      REQUIRE(t.constrain(s.first, s.second, Side::inside, Side::outside) != expected);
      ++(expected ? obstructed : segments);
      if (!expected) done.push_back(s);
    }
    check_triangulation(t, 2 * 16 * 16);
    for (int n = 0; n < 20; ++n) {  // segments stay where triangles are split
      const FaceId f(random.below(static_cast<std::uint32_t>(t.triangles().size())));
      const auto& [a, b, c] = t.triangle(f).v;
      const Vec2 p = (1.0 / 3) * (t.point(a) + t.point(b) + t.point(c));
      if (std::min({orient2d(t.point(a), t.point(b), p), orient2d(t.point(b), t.point(c), p),
                    orient2d(t.point(c), t.point(a), p)}) > 0) {
        t.insert_in(f, p);
      }
    }
    check_triangulation(t, 2 * 16 * 16);
    for (const auto& [a, b] : done) {
      const PlaneEdge left = t.find_edge(a, b), right = t.find_edge(b, a);
      REQUIRE((left.t != kNoId || right.t != kNoId));
      if (left.t != kNoId) CHECK(t.triangle(left.t).side[left.i] != Side::none);
      if (right.t != kNoId) CHECK(t.triangle(right.t).side[right.i] != Side::none);
    }
  }
  CHECK(segments > 2000);
  CHECK(obstructed > 2000);
  CHECK(duplicates > 100);
}

TEST_CASE("sides and segments split at a given point stay marked") {
  ConstrainedTriangulation t({0, 0}, {8, 8});
  const VertexId a = t.insert({2, 2}), b = t.insert({6, 2});
  t.insert({3, 7});
  REQUIRE(t.constrain(a, b, Side::inside, Side::outside));
  t.triangle(t.find_edge(a, b).t).inside = true;
  const VertexId m = t.split_edge(t.find_edge(a, b), {4, 2});
  const VertexId n = t.split_edge(t.find_edge(0, 1), {4, 0});
  check_triangulation(t, 2 * 8 * 8);
  for (const auto& [p, q] : {std::pair{a, m}, std::pair{m, b}}) {
    const PlaneEdge left = t.find_edge(p, q), right = t.find_edge(q, p);
    REQUIRE(left.t != kNoId);
    CHECK(t.triangle(left.t).side[left.i] == Side::inside);
    CHECK(t.triangle(left.t).inside);
    CHECK_FALSE(t.triangle(right.t).inside);
    CHECK(t.triangle(right.t).side[right.i] == Side::outside);
  }
  CHECK(t.find_edge(0, n).t != kNoId);
  CHECK(t.find_edge(n, 0).t == kNoId);
}
