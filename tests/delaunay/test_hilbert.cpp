// SPDX-License-Identifier: MIT
#include "delaunay/hilbert.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "delaunay/point_sets.h"

using namespace deliso;

TEST_CASE("Hilbert's curve visits every cell once, and each sharing a face with the last") {
  for (int bits = 1; bits <= 5; ++bits) {
    CAPTURE(bits);
    const std::uint32_t side = 1u << bits;
    std::vector<std::array<int, 3>> path(side * side * side, {-1, -1, -1});
    for (std::uint32_t x = 0; x < side; ++x)
      for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t z = 0; z < side; ++z) {
          const std::uint64_t i = hilbert_index(x, y, z, bits);
          REQUIRE(i < path.size());
          REQUIRE(path[i][0] == -1);
          path[i] = {static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)};
        }
    for (std::size_t i = 1; i < path.size(); ++i) {
      int steps = 0;
      for (int axis = 0; axis < 3; ++axis) steps += std::abs(path[i][axis] - path[i - 1][axis]);
      REQUIRE(steps == 1);
    }
  }
}

TEST_CASE("biased_hilbert_order is a permutation, also of no point, one point and equal points") {
  for (std::size_t n : {0, 1, 2, 1000}) {
    for (bool same : {false, true}) {
      std::vector<Vec3> points;
      if (n > 0) points = oracle::make_point_set(oracle::PointSet::kRandom, static_cast<int>(n), n);
      if (same) std::fill(points.begin(), points.end(), Vec3{1, 2, 3});
      auto order = biased_hilbert_order(points);
      std::sort(order.begin(), order.end());
      REQUIRE(order.size() == n);
      for (std::size_t i = 0; i < n; ++i) REQUIRE(order[i] == i);
    }
  }
}

TEST_CASE("successive points of the order are close together") {
  // In a random order of n points in the unit cube the mean step is 0.66.
  const auto points = oracle::make_point_set(oracle::PointSet::kRandom, 100'000, 3);
  const auto order = biased_hilbert_order(points);
  double sum = 0;
  for (std::size_t i = 1; i < order.size(); ++i)
    sum += distance(points[order[i - 1]], points[order[i]]) / 2;  // the cube's side is 2
  CHECK(sum / static_cast<double>(order.size()) < 0.04);
}
