// SPDX-License-Identifier: MIT
// The grid against a test of every facet, while facets of all sizes are added and removed.
#include "embedding/box_grid.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "base/random.h"
#include "base/triangle.h"

using namespace deliso;

namespace {

Vec3 random_point(Random& random, const Box3& box) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) {
    p[axis] = random.uniform(box.lo[axis], box.hi[axis]);
    // On the box's faces, edges and corners to the last bit.
    const std::uint32_t kind = random.below(12);
    if (kind == 0) p[axis] = box.lo[axis];
    if (kind == 1) p[axis] = box.hi[axis];
  }
  return p;
}

// Three corners in the box, up to `size` apart along each axis.
std::array<Vec3, 3> random_triangle(Random& random, const Box3& box, double size) {
  const Vec3 at = random_point(random, box);
  std::array<Vec3, 3> corners;
  for (Vec3& p : corners) {
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = std::clamp(at[axis] + random.uniform(-size, size), box.lo[axis], box.hi[axis]);
    }
  }
  return corners;
}

Box3 exact_box(std::span<const Vec3> points) {
  Box3 box{points[0], points[0]};
  for (const Vec3& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], p[axis]);
      box.hi[axis] = std::max(box.hi[axis], p[axis]);
    }
  }
  return box;
}

bool meet(const Box3& a, const Box3& b, double margin) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.lo[axis] > b.hi[axis] + margin || b.lo[axis] > a.hi[axis] + margin) return false;
  }
  return true;
}

// A grid, and the same facets in a plain list.
struct Twin {
  Twin(const Box3& b, double cell_size) : box(b), cell(cell_size), grid(b, cell_size) {}

  void add(FaceId f, const std::array<Vec3, 3>& corners) {
    if (f >= facets.size()) facets.resize(f + 1);
    facets[f] = corners;
    grid.add(f, grid.box_of(corners));
    present.insert(f);
  }
  void remove(FaceId f) {
    grid.remove(f);
    present.erase(f);
  }

  // Everything that meets the query is found, and nothing further from it than single precision
  // explains.
  void ask(const BoxGrid::Box& query, const Box3& exact) const {
    const Vec3 size = box.size();
    const double margin = 4e-6 * (std::max({size.x, size.y, size.z}) + 2 * cell);
    std::set<FaceId> found;
    REQUIRE_FALSE(grid.any(query, [&](FaceId f, const BoxGrid::Box& of_f) {
      REQUIRE(present.contains(f));
      CHECK(BoxGrid::meet(of_f, query));
      found.insert(f);
      return false;
    }));
    for (const FaceId f : present) {
      const Box3 of_f = exact_box(facets[f]);
      if (meet(of_f, exact, 0)) REQUIRE(found.contains(f));
      if (found.contains(f)) REQUIRE(meet(of_f, exact, margin));
    }
    // It stops at the first element that satisfies the predicate, and returns true.
    if (found.empty()) return;
    const FaceId wanted = *found.rbegin();
    CHECK(grid.any(query, [&](FaceId f, const BoxGrid::Box&) { return f == wanted; }));
  }

  void ask_at_random(Random& random, double size) const {
    if (random.below(2) == 0) {
      const auto corners = random_triangle(random, box, size);
      ask(grid.box_of(corners), exact_box(corners));
      return;
    }
    // Balls may extend outside the box, or lie wholly outside.
    Vec3 center;
    for (int axis = 0; axis < 3; ++axis) {
      const double side = box.size()[axis];
      center[axis] = random.uniform(box.lo[axis] - 0.3 * side, box.hi[axis] + 0.3 * side);
    }
    const Vec3 reach{size, size, size};
    ask(grid.box_around(center, size), {center - reach, center + reach});
  }

  Box3 box;
  double cell;
  BoxGrid grid;
  std::vector<std::array<Vec3, 3>> facets;
  std::set<FaceId> present;
};

double random_size(Random& random, double longest) {
  return longest * std::pow(10.0, random.uniform(-4, 0));
}

}  // namespace

TEST_CASE(
    "all that meets a query is found after additions and removals, at sizes over four orders") {
  std::uint64_t seed = 0;
  for (const Vec3 sides : {Vec3{9, 7, 5}, Vec3{4, 0.01, 300}, Vec3{1e-6, 2e-6, 1e-6},
                           Vec3{3e7, 1e7, 2e7}, Vec3{5, 0, 0}}) {
    const double longest = std::max({sides.x, sides.y, sides.z});
    for (const double cell : {1e-5, 1e-2, 0.3, 50.0}) {
      ++seed;
      CAPTURE(seed);
      Random random(seed);
      const Box3 box{{-1, 2, 0}, Vec3{-1, 2, 0} + sides};
      Twin twin(box, cell * longest);
      for (int step = 0; step < 1200; ++step) {
        const FaceId f(random.below(300));
        if (twin.present.contains(f)) {
          twin.remove(f);
        } else {
          const double size = random.below(4) == 0 ? 0 : random_size(random, longest);
          twin.add(f, random_triangle(random, box, size));
        }
        if (step % 3 == 0) twin.ask_at_random(random, random_size(random, longest));
      }
      CHECK(twin.present.size() > 50);
    }
  }
}

TEST_CASE("a grid that grows to thousands of facets still finds each of them") {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Box3 box{{0, 0, 0}, {100, 80, 60}};
    Twin twin(box, 1);
    FaceId next = 0;
    for (const int wanted : {1000, 1100, 3000, 9000}) {  // lists double at 1024, 2048, ...
      while (twin.present.size() < static_cast<std::size_t>(wanted)) {
        twin.add(next++, random_triangle(random, box, random_size(random, 20)));
        if (random.below(4) == 0) twin.remove(*twin.present.begin());
      }
      for (int n = 0; n < 60; ++n) twin.ask_at_random(random, random_size(random, 30));
      for (const FaceId f : twin.present) {
        const BoxGrid::Box own = twin.grid.box_of(twin.facets[f]);
        REQUIRE(twin.grid.any(own, [&](FaceId g, const BoxGrid::Box&) { return g == f; }));
      }
    }
    while (!twin.present.empty()) twin.remove(*twin.present.begin());
    twin.ask_at_random(random, 100);
    twin.add(5, random_triangle(random, box, 1));
    twin.ask(twin.grid.box_of(twin.facets[5]), exact_box(twin.facets[5]));
  }
}

TEST_CASE("boxes and balls with a common point meet, in single precision, too") {
  Random random(4);
  for (int n = 0; n < 2000; ++n) {
    const double longest = std::pow(10.0, random.uniform(-6, 6));
    const Vec3 low{random.uniform(-longest, longest), 0, random.uniform(0, 10 * longest)};
    const Box3 box{low, low + Vec3{longest, 0.5 * longest, random.uniform() * longest}};
    const BoxGrid grid(box, longest * std::pow(10.0, random.uniform(-7, 1)));
    // Of two triangles with a common corner the boxes always meet; also of points to the last bit.
    const auto a = random_triangle(random, box, longest);
    auto b = random_triangle(random, box, 1e-3 * longest);
    b[random.below(3)] = a[random.below(3)];
    CHECK(BoxGrid::meet(grid.box_of(a), grid.box_of(b)));
    const std::vector<Vec3> points(a.begin(), a.end());
    CHECK(BoxGrid::meet(grid.box_of(points, {0, 1, 2}), grid.box_of(b)));
    // A ball that reaches just to a point of the triangle.
    Vec3 center = a[0];
    center[static_cast<int>(random.below(3))] += longest * random.uniform(-1, 1);
    CHECK(BoxGrid::meet(grid.box_around(center, distance(center, a[0])), grid.box_of(a[0])));
  }
}

// With an r_min as large as the volume all facets are in one cell.
TEST_CASE("any number of facets fits into one cell") {
  const Box3 box{{0, 0, 0}, {10, 10, 10}};
  BoxGrid grid(box, 1000);
  Random random(5);
  constexpr FaceId kMany = 70000;
  for (FaceId f = 0; f < kMany; ++f) {
    const auto corners = random_triangle(random, box, 0.1);
    grid.add(f, grid.box_of(corners));
  }
  std::size_t asked = 0;
  grid.any(grid.box_around({5, 5, 5}, 100), [&](FaceId, const BoxGrid::Box&) {
    ++asked;
    return false;
  });
  CHECK(asked >= kMany);
}
