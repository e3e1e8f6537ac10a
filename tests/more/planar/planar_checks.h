// SPDX-License-Identifier: MIT
// Brute-force tests of the invariants of a constrained triangulation.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "more/planar/constrained_triangulation.h"
#include "more/planar/plane_predicates.h"

namespace deliso {

inline double twice_area(const ConstrainedTriangulation& t, const PlaneTriangle& at) {
  const Vec2 u = t.point(at.v[1]) - t.point(at.v[0]), v = t.point(at.v[2]) - t.point(at.v[0]);
  return u.x * v.y - u.y * v.x;
}

// I1 to I4. The sum of areas is exact where coordinates are short.
inline void check_triangulation(const ConstrainedTriangulation& t, double twice_whole) {
  double sum = 0;
  std::vector<bool> used(t.points().size(), false);
  for (FaceId f = 0; f < t.triangles().size(); ++f) {
    const PlaneTriangle& at = t.triangle(f);
    const Vec2 &a = t.point(at.v[0]), &b = t.point(at.v[1]), &c = t.point(at.v[2]);
    REQUIRE(orient2d(a, b, c) > 0);
    sum += twice_area(t, at);
    for (int i = 0; i < 3; ++i) {
      used[at.v[i]] = true;
      const VertexId p = at.v[(i + 1) % 3], q = at.v[(i + 2) % 3];
      const PlaneEdge e = t.find_edge(p, q);
      REQUIRE(e.t == f);
      REQUIRE(e.i == i);
      if (at.n[i] == kNoId) {
        const Vec2 &x = t.point(p), &y = t.point(q), &lo = t.point(0), &hi = t.point(2);
        const bool on_side = (x.x == lo.x && y.x == lo.x) || (x.x == hi.x && y.x == hi.x) ||
                             (x.y == lo.y && y.y == lo.y) || (x.y == hi.y && y.y == hi.y);
        REQUIRE(on_side);
        continue;
      }
      const PlaneTriangle& g = t.triangle(at.n[i]);
      const int back = g.n[0] == f ? 0 : g.n[1] == f ? 1 : 2;
      REQUIRE(g.n[back] == f);
      REQUIRE(g.v[(back + 1) % 3] == q);
      REQUIRE(g.v[(back + 2) % 3] == p);
      REQUIRE((g.side[back] == Side::none) == (at.side[i] == Side::none));
      if (at.side[i] == Side::none) REQUIRE(incircle(a, b, c, t.point(g.v[back])) <= 0);
    }
  }
  CHECK(sum == doctest::Approx(twice_whole).epsilon(1e-12));
  CHECK(std::all_of(used.begin(), used.end(), [](bool u) { return u; }));
}

}  // namespace deliso
