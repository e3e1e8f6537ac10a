// SPDX-License-Identifier: MIT
// Points inside by their distances, by what they are without the test for cubes outside, and by
// their number in long solids.
#include "more/solids/lattice.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "base/triangle.h"
#include "more/solids/skins.h"

using namespace deliso;
using namespace deliso::test;

namespace {

constexpr auto kNowhere = [](const Vec3&) { return false; };

Skin turned(Skin skin, const std::array<Vec3, 3>& axes) {
  for (Vec3& p : skin.points) p = p.x * axes[0] + p.y * axes[1] + p.z * axes[2];
  return skin;
}

// A bar of 1 by 1 along the third axis.
Skin bar(double length) {
  Random random(1);
  Skin skin = cubes_skin(
      1, [](int, int, int) { return 1u; }, random);
  for (Vec3& p : skin.points) p.z *= length;
  return skin;
}

}  // namespace

TEST_CASE("a long bar has points by its volume, however it lies") {
  // The cube around it has hundreds of times as many.
  const double s = std::sqrt(.5), t = std::sqrt(1. / 3), u = std::sqrt(1. / 6);
  const std::array<Vec3, 3> straight{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}},
      diagonal{Vec3{s, -s, 0}, Vec3{u, u, -2 * u}, Vec3{t, t, t}};
  for (const auto& axes : {straight, diagonal}) {
    const Skin skin = turned(bar(24), axes);
    const auto is_outside = [&](const Vec3& p) {
      const double x = dot(p, axes[0]), y = dot(p, axes[1]), z = dot(p, axes[2]);
      return std::min({x, y, z, 1 - x, 1 - y, 24 - z}) < 0;
    };
    LatticeOptions options;
    options.max_edge = .4;
    const std::vector<Vec3> points = lattice_points(skin.points, skin.walls, options, is_outside);
    const auto inside =
        points.size() - static_cast<std::size_t>(std::ranges::count_if(points, is_outside));
    CHECK(inside > 400);
    CHECK(points.size() < 12 * inside);
  }
}

TEST_CASE("no point inside is lost where cubes outside are left out") {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    CAPTURE(seed);
    Random random(seed);
    const auto region = [&](int i, int j, int k) {
      return (i * 7 + j * 3 + k * 5 + static_cast<int>(seed)) % 4 == 0 ? 1u : kOutside;
    };
    const Skin skin = cubes_skin(6, region, random);
    const auto is_outside = [&](const Vec3& p) {
      const int i = static_cast<int>(std::floor(p.x)), j = static_cast<int>(std::floor(p.y)),
                k = static_cast<int>(std::floor(p.z));
      const auto is_in = [](int n) { return 0 <= n && n < 6; };
      return !is_in(i) || !is_in(j) || !is_in(k) || region(i, j, k) == kOutside;
    };
    LatticeOptions options;
    options.max_edge = .11;
    const auto inner = [&](const IsOutside& test) {
      std::vector<Vec3> points = lattice_points(skin.points, skin.walls, options, test);
      const std::size_t all = points.size();
      std::erase_if(points, is_outside);
      std::ranges::sort(points, {}, [](const Vec3& p) { return std::array{p.x, p.y, p.z}; });
      return std::pair(points, all);
    };
    const auto [every, most] = inner(kNowhere);
    const auto [found, all] = inner(is_outside);
    CHECK(every == found);
    CHECK(found.size() > 10000);
    CHECK(all < most);
  }
}

TEST_CASE("the longest edge of the lattice is max_edge, in a box of any size") {
  Random random(2);
  for (const double size : {1., 1.3, 1.7}) {
    CAPTURE(size);
    Skin skin = cubes_skin(
        8, [](int, int, int) { return 1u; }, random);
    for (Vec3& p : skin.points) p = size * p;
    LatticeOptions options;
    options.max_edge = .6;
    const std::vector<Vec3> points = lattice_points(skin.points, skin.walls, options, kNowhere);
    const Vec3 middle{4 * size, 4 * size, 4 * size};
    std::set<double> near;
    for (const Vec3& p : points) {
      if (distance(p, middle) <= 1.01 * .6)
        near.insert(std::round(1e6 * distance(p, middle)) / 1e6);
    }
    // The middle of the box is a corner of cubes.
    CHECK(near == std::set{0., std::round(.6e6 * std::sqrt(.75)) / 1e6, .6});
  }
}
