// SPDX-License-Identifier: MIT
// The exact intersection test against separating axes in integers, on a small grid, where touching,
// folding and overlapping in a plane are common.
#include "embedding/triangle_pair.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/random.h"
#include "check/self_intersections.h"
#include "embedding/all_crossings.h"
#include "exact/predicates.h"

namespace deliso {
namespace {

using Int3 = std::array<std::int64_t, 3>;
using Int3x3 = std::array<Int3, 3>;

Int3 minus(const Int3& a, const Int3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Int3 cross_of(const Int3& a, const Int3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
std::int64_t dot_of(const Int3& a, const Int3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Two convex sets are apart exactly if one of these axes separates them. These are the normals of
// the planes that touch both (along a face, or an edge of each), and those within a common plane.
bool meet(const Int3x3& s, const Int3x3& t) {
  std::vector<Int3> axes;
  const auto edge = [](const Int3x3& x, int i) { return minus(x[(i + 1) % 3], x[i]); };
  const Int3 n = cross_of(edge(s, 0), edge(s, 1)), m = cross_of(edge(t, 0), edge(t, 1));
  axes.insert(axes.end(), {n, m});
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) axes.push_back(cross_of(edge(s, i), edge(t, j)));
    for (const Int3& normal : {n, m}) {
      axes.push_back(cross_of(normal, edge(s, i)));
      axes.push_back(cross_of(normal, edge(t, i)));
    }
  }
  for (const Int3& axis : axes) {
    const auto range = [&](const Int3x3& x) {
      return std::minmax({dot_of(axis, x[0]), dot_of(axis, x[1]), dot_of(axis, x[2])});
    };
    const auto [s_lo, s_hi] = range(s);
    const auto [t_lo, t_hi] = range(t);
    if (s_hi < t_lo || t_hi < s_lo) return false;
  }
  return true;
}

// The triangle a b c with a as its apex, so large that its far side is out of reach of the others.
Int3x3 sector(const Int3x3& t) {
  constexpr std::int64_t kFar = 2000;
  Int3x3 out{t[0], t[0], t[0]};
  for (int i = 1; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) out[i][axis] += kFar * (t[i][axis] - t[0][axis]);
  }
  return out;
}

struct Soup {
  std::vector<Vec3> points;
  std::vector<Int3> exact;
  std::vector<Triangle> triangles;

  Int3x3 corners(const Triangle& t) const { return {exact[t[0]], exact[t[1]], exact[t[2]]}; }
};

// Triangles on all points of a grid of size^3, in planes of it now and then. In every fourth the
// planes are far from each other, and the places the same but for that.
Soup random_soup(std::uint64_t seed, int size, std::size_t count) {
  Soup soup;
  const double apart = seed % 4 == 0 ? 0x1p60 : 1;
  for (int z = 0; z < size; ++z) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        soup.points.push_back({double(x), double(y), apart * (z + 1)});
        soup.exact.push_back({x, y, z});
      }
    }
  }
  Random random(seed);
  const auto layer = static_cast<std::uint32_t>(size * size);
  const auto all = static_cast<std::uint32_t>(soup.points.size());
  while (soup.triangles.size() < count) {
    const std::uint32_t within = random.below(3) == 0 ? layer : all;
    const std::uint32_t a = random.below(within), b = random.below(within);
    const Triangle t = triangle_of(a, b, random.below(within));
    const auto& p = soup.points;
    if (!collinear(p[t[0]], p[t[1]], p[t[2]])) soup.triangles.push_back(t);
  }
  return soup;
}

// True if s and t meet outside their shared vertex or edge, by integers.
bool expected(const Soup& soup, const Triangle& s, const Triangle& t, int& shared) {
  Triangle u = s, v = t;
  const auto in = [](const Triangle& x) {
    return [&x](VertexId id) { return std::find(x.begin(), x.end(), id) != x.end(); };
  };
  const auto split = std::stable_partition(u.begin(), u.end(), in(t));
  shared = static_cast<int>(split - u.begin());
  std::stable_partition(v.begin(), v.end(), in(s));
  const Int3x3 a = soup.corners(u), b = soup.corners(v);
  if (shared == 3) return true;
  if (shared == 0) return meet(a, b);
  if (shared == 1) {  // do the two sectors share a ray? then it leaves one of them by its far side
    return meet({a[1], a[2], a[2]}, sector(b));
  }
  const Int3 along = minus(a[1], a[0]);
  const Int3 n = cross_of(along, minus(a[2], a[0])), m = cross_of(along, minus(b[2], a[0]));
  return cross_of(n, m) == Int3{} && dot_of(n, m) > 0;
}

}  // namespace

TEST_CASE("triangles_intersect agrees with separating axes in integers on a small grid") {
  std::array<std::array<int, 2>, 4> seen{};
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Soup soup = random_soup(seed, seed % 2 == 0 ? 3 : 5, 40);
    for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        int shared = 0;
        const bool truth = expected(soup, soup.triangles[i], soup.triangles[j], shared);
        ++seen[static_cast<std::size_t>(shared)][truth];
        if (triangles_intersect(soup.points, soup.triangles[i], soup.triangles[j]) == truth)
          continue;
        FAIL_CHECK("seed " << seed << " pair " << i << " " << j << " shared " << shared);
      }
    }
  }
  for (std::size_t shared = 0; shared < 3; ++shared) {
    CHECK(seen[shared][0] > 1000);
    CHECK(seen[shared][1] > 100);
  }
}

TEST_CASE("the tree finds the pairs that all pairs give") {
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Soup soup = random_soup(seed, 9, 150);
    const auto all = test::all_crossings(soup.points, soup.triangles);
    const TriangleTree tree(soup.points, soup.triangles);
    CAPTURE(seed);
    CHECK(find_crossings(soup.points, soup.triangles, tree).pairs == all);
    found += all.size();
  }
  CHECK(found > 1000);
}

}  // namespace deliso
