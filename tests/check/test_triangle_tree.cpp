// SPDX-License-Identifier: MIT
// The tree over triangles: the same on every machine, and the nearest triangle by brute force.
#include "check/triangle_tree.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "base/random.h"

using namespace deliso;

namespace {

// Triangles at the nodes of a grid: many have their middles at one coordinate.
struct SquareMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;

  explicit SquareMesh(int side) {
    Random random(1);
    for (int n = 0; n < 4 * side * side; ++n) {
      const Vec3 at{1.0 * random.below(static_cast<std::uint32_t>(side)),
                    1.0 * random.below(static_cast<std::uint32_t>(side)), 0};
      const VertexId first(points.size());
      points.insert(points.end(), {at, at + Vec3{1, 0, 0}, at + Vec3{0, 1, 0}});
      triangles.push_back({first, VertexId(first + 1), VertexId(first + 2)});
    }
  }
};

}  // namespace

TEST_CASE("a leaf has its triangles in the order of their numbers") {
  const SquareMesh grid(20);
  for (const int threads : {1, 2}) {
    const TriangleTree tree(grid.points, grid.triangles, threads);
    std::vector<FaceId> all;
    for (std::size_t n = 0; n < tree.leaf_count(); ++n) {
      CHECK(std::ranges::is_sorted(tree.leaf(n)));
      all.insert(all.end(), tree.leaf(n).begin(), tree.leaf(n).end());
    }
    std::ranges::sort(all);
    REQUIRE(all.size() == grid.triangles.size());
    for (FaceId f = 0; f < all.size(); ++f) CHECK(all[f] == f);
  }
}

TEST_CASE("the nearest triangle is as near as any") {
  const SquareMesh grid(8);
  const TriangleTree tree(grid.points, grid.triangles);
  Random random(2);
  for (int n = 0; n < 500; ++n) {
    const Vec3 p{random.uniform(-2, 10), random.uniform(-2, 10), random.uniform(-2, 2)};
    double least = tree.distance2(0, p);
    for (FaceId f = 1; f < grid.triangles.size(); ++f)
      least = std::min(least, tree.distance2(f, p));
    const NearestTriangle nearest = tree.nearest(p);
    CHECK(nearest.distance2 == least);
    CHECK(tree.distance2(nearest.triangle, p) == least);
  }
}

TEST_CASE("a tree of several tasks is the same on any number of threads") {
  const SquareMesh grid(200);  // of 80,000 triangles
  const TriangleTree one(grid.points, grid.triangles), two(grid.points, grid.triangles, 2);
  REQUIRE(one.leaf_count() > 1u << 13);
  for (std::size_t n = 0; n < one.leaf_count(); ++n) {
    REQUIRE(std::ranges::equal(one.leaf(n), two.leaf(n)));
  }
  Random random(5);
  for (int n = 0; n < 20; ++n) {
    const Vec3 p{random.uniform(0, 200), random.uniform(0, 200), random.uniform(-3, 3)};
    double least = one.distance2(0, p);
    for (FaceId f = 1; f < grid.triangles.size(); ++f) least = std::min(least, one.distance2(f, p));
    CHECK(two.nearest(p).distance2 == least);
  }
}

// Points near the mesh are found by the triangles around which they are, the others by the tree.
TEST_CASE("nearest triangles of points near and far are those of brute force") {
  const SquareMesh grid(8);
  const TriangleTree tree(grid.points, grid.triangles);
  Random random(3);
  std::vector<Vec3> points;
  for (int n = 0; n < 1000; ++n) {
    const double height = n % 10 == 0 ? 5 : 0.3;
    points.push_back({random.uniform(-1, 10), random.uniform(-1, 10), random.uniform(0, height)});
  }
  for (const int threads : {1, 2}) {
    const std::vector<NearestTriangle> found = tree.nearest(points, threads);
    for (std::size_t n = 0; n < points.size(); ++n) {
      double least = tree.distance2(0, points[n]);
      for (FaceId f = 1; f < grid.triangles.size(); ++f) {
        least = std::min(least, tree.distance2(f, points[n]));
      }
      CHECK(found[n].distance2 == least);
      CHECK(tree.distance2(found[n].triangle, points[n]) == least);
    }
  }
}
