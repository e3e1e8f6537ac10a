// SPDX-License-Identifier: MIT
// Needles, folds and near vertices: at their limits, and as brute force finds them.
#include "check/close_places.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "coarsen/contour_as_mesh.h"
#include "fields.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

// Values grow downwards from the plane z = 5, on both sides of it if `sheet`.
Volume falling(bool sheet) {
  return sampled<float>({11, 11, 11}, {1, 1, 1},
                        [&](int, int, int k) { return sheet ? -std::abs(k - 5) : 5 - k; });
}

ClosePlaces found_in(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                     const Volume& volume, int threads = 1) {
  const VertexGrids grids(points, triangles);
  return find_close_places(points, triangles, edge_uses(points.size(), triangles), grids,
                           source_of(volume), threads);
}

double tangent(double degrees) {
  return std::tan(degrees * std::numbers::pi / 180);
}

}  // namespace

TEST_CASE("a needle has an angle below a hundredth of a degree") {
  const Volume volume = falling(false);
  for (const double degrees : {0.0101, 0.0099, 1e-9}) {
    CAPTURE(degrees);
    for (int turn = 0; turn < 3; ++turn) {
      std::vector<Vec3> points{{1, 1, 5}, {5, 1, 5}, {5, 1 + 4 * tangent(degrees), 5}};
      std::rotate(points.begin(), points.begin() + turn, points.end());
      const bool is_needle = degrees < kLeastAngle;
      CHECK(found_in(points, {{0, 1, 2}}, volume).needles.size() == (is_needle ? 1 : 0));
    }
  }
}

TEST_CASE("a fold has an angle below one degree, and the surface has none there") {
  for (const double degrees : {0.99, 1.01, 0.02, 90.0}) {
    CAPTURE(degrees);
    const double height = 1.5 * tangent(degrees / 2);
    // Two triangles at the edge from 0 to 1, open towards greater y.
    const std::vector<Vec3> points{
        {2, 2, 5}, {6, 2, 5}, {4, 3.5, 5 + height}, {4, 3.5, 5 - height}};
    const std::vector<Triangle> triangles{{0, 1, 2}, {1, 0, 3}};
    const bool is_fold = degrees < kLeastFold;
    const ClosePlaces found = found_in(points, triangles, falling(false));
    CHECK(found.needles.empty());
    CHECK(found.folds.size() == (is_fold ? 1 : 0));
    // The rim of a thin sheet.
    CHECK(found_in(points, triangles, falling(true)).folds.empty());
    // The same sheet inside out.
    CHECK(found_in(points, {{1, 0, 2}, {0, 1, 3}}, falling(true)).folds.size() ==
          (is_fold ? 1 : 0));
  }
}

TEST_CASE("a vertex is near a triangle of others up to .0006 voxels") {
  const Volume volume = falling(false);  // ten voxels a side
  std::vector<Vec3> points{{1, 1, 5}, {9, 1, 5}, {1, 9, 5}};
  std::vector<Triangle> triangles{{0, 1, 2}};
  const auto near_with = [&](const Vec3& tip) {
    std::vector<Vec3> all = points;
    all.insert(all.end(), {tip, {0.5, 0, 8}, {0, 0, 8}});
    std::vector<Triangle> both = triangles;
    both.push_back({3, 4, 5});
    return found_in(all, both, volume).near;
  };
  for (const double height : {5.99e-4, 6.01e-4}) {
    CAPTURE(height);
    const std::size_t expected = height < 6e-4 ? 1 : 0;
    CHECK(near_with({3, 3, 5 + height}).size() == expected);      // over the triangle
    CHECK(near_with({5, 1 - height, 5}).size() == expected);      // beside an edge
    CHECK(near_with({1 - height, 1, 5}).size() == 2 * expected);  // at a vertex: both are near
  }
  const auto near = near_with({3, 3, 5.00001});
  REQUIRE(near.size() == 1);
  CHECK(near[0] == std::pair{VertexId(3), FaceId(0)});
  // Its own triangles are no others; nor is a vertex that no triangle uses near one.
  points.push_back({3, 3, 5.00001});
  CHECK(found_in(points, triangles, volume).near.empty());
}

TEST_CASE("one place is found once") {
  // The third triangle is a needle folded on the first, and its tip is near the second.
  const std::vector<Vec3> points{{2, 2, 5}, {6, 2, 5}, {4, 6, 5}, {4, 2.0001, 5.0001}, {4, -2, 5}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {1, 0, 3}, {4, 0, 3}};
  const ClosePlaces found = found_in(points, triangles, falling(false));
  CHECK(found.needles == std::vector{FaceId(1)});
  CHECK(found.folds.empty());
  CHECK(found.near.empty());
}

// The contour of noise is full of small triangles, some of them near others.
TEST_CASE("brute force finds the same near vertices, whatever the number of threads") {
  std::size_t near = 0;
  for (const int stretch : {1, 100}) {
    const Scene scene = wave_scene(7, 14, {1, 1, 1.0 * stretch});
    const std::vector<Vec3>& points = scene.contour.points;
    const std::vector<Triangle> triangles = contour_as_mesh(scene.contour).mesh.triangles();
    // Of voxels twenty times as large, so that some are near.
    const Volume volume = wave_scene(7, 14, {20, 20, 20.0 * stretch}).volume;
    const ClosePlaces found = found_in(points, triangles, volume);
    const double limit = near_distance(volume);
    std::vector<std::uint8_t> is_closed(points.size(), 0), is_near(points.size(), 0);
    const auto close = [&](FaceId f) {
      for (const VertexId v : triangles[f]) is_closed[v] = 1;
    };
    for (const FaceId f : found.needles) close(f);
    for (const auto& [f, g] : found.folds) {
      close(f);
      close(g);
    }
    for (const auto& [v, f] : found.near) is_near[v] = 1;
    const TriangleTree tree(points, triangles);
    for (VertexId v = 0; v < points.size(); ++v) {
      bool expected = false;
      for (FaceId f = 0; f < triangles.size() && !expected && !is_closed[v]; ++f) {
        expected = !has_corner(triangles[f], v) && tree.distance2(f, points[v]) < limit * limit;
      }
      CHECK_MESSAGE((is_near[v] != 0) == expected, v);
    }
    near += found.near.size();
    CHECK(found_in(points, triangles, volume, 3).near == found.near);
  }
  CHECK(near > 0);
}

TEST_CASE("places of caps are those with a cap, or with a vertex of caps alone") {
  const std::vector<Triangle> triangles{{0, 1, 2}, {2, 1, 3}, {3, 1, 4}, {4, 1, 5}};
  const std::vector<bool> is_cap{false, false, true, true};
  ClosePlaces found;
  CHECK(count_at_caps(found, triangles, is_cap) == 0);
  found.needles = {0, 2};
  CHECK(count_at_caps(found, triangles, is_cap) == 1);
  found.folds = {{0, 1}, {1, 2}, {2, 3}};
  CHECK(count_at_caps(found, triangles, is_cap) == 3);
  // Vertex 3 is of the surface too, 5 is not.
  found.near = {{3, 0}, {0, 3}, {5, 0}};
  CHECK(count_at_caps(found, triangles, is_cap) == 5);
}
