// SPDX-License-Identifier: MIT
// Hard point sets for a Delaunay triangulation, each from its seed.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "base/vec3.h"

namespace deliso::oracle {

enum class PointSet {
  kRandom,
  kOnSphere,        // rounded points of a sphere
  kCospherical,     // integers of one squared length
  kGrid,            // all points of a small cubic grid, shuffled
  kCoarseGrid,      // random points of a grid, many of them twice
  kCoplanarAndOne,  // a plane's grid and one point off it
  kNearlyCoplanar,  // a tilted plane up to rounding
  kClustered,       // tight clusters far apart
  kTwoLines,        // n/2 points on each of two skew lines: n^2 cells
  kAnisotropic,     // 1 : 1000 : 1000000
  kCount
};

// pre: n >= 8. Every set spans space.
inline std::vector<Vec3> make_point_set(PointSet kind, int n, std::uint64_t seed) {
  Random random(seed);
  const auto in_cube = [&] {
    return Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  };
  const auto direction = [&] {
    while (true) {
      const Vec3 p = in_cube();
      if (length2(p) < 1 && length2(p) > 0.01) return p / length(p);
    }
  };
  const auto below = [&](std::uint32_t k) { return static_cast<double>(random.below(k)); };
  std::vector<Vec3> points;
  const int side = std::max(2, static_cast<int>(std::cbrt(n)));
  for (int i = 0; i < n; ++i) {
    switch (kind) {
      case PointSet::kRandom:
        points.push_back(in_cube());
        break;
      case PointSet::kOnSphere:
        points.push_back(Vec3{3, 4, 5} + direction());
        break;
      case PointSet::kCospherical: {
        Vec3 p{16, 13, 5};  // squared length 450, as of (20, 5, 5) and (19, 8, 5)
        if (i % 3 == 1) p = {20, 5, 5};
        if (i % 3 == 2) p = {19, 8, 5};
        for (int k = 0; k < 3; ++k) {
          std::swap(p[k], p[static_cast<int>(random.below(3))]);
          if (random.below(2)) p[k] = -p[k];
        }
        points.push_back(p);
        break;
      }
      case PointSet::kGrid:
        if (i < side * side * side)
          points.push_back({double(i % side), double(i / side % side), double(i / side / side)});
        break;
      case PointSet::kCoarseGrid:
        points.push_back({below(4), below(4), below(4)});
        break;
      case PointSet::kCoplanarAndOne:
        points.push_back(i == 5 ? Vec3{2, 2, 1} : Vec3{below(6), below(6), 0});
        break;
      case PointSet::kNearlyCoplanar: {
        const double u = random.uniform(), v = random.uniform();
        points.push_back({u, v, 1 - u / 3 - v / 7});
        break;
      }
      case PointSet::kClustered:
        points.push_back((i % 4) * Vec3{10, 20, -30} + std::ldexp(1.0, -30) * in_cube());
        break;
      case PointSet::kTwoLines:
        points.push_back(i % 2 ? Vec3{i / 64.0, 0, 1} : Vec3{0, i / 64.0, -1});
        break;
      case PointSet::kAnisotropic: {
        const Vec3 p = in_cube();
        points.push_back({p.x, 1e3 * p.y, 1e6 * p.z});
        break;
      }
      case PointSet::kCount:
        break;
    }
  }
  for (std::size_t i = points.size(); i > 1; --i)
    std::swap(points[i - 1], points[random.below(static_cast<std::uint32_t>(i))]);
  return points;
}

}  // namespace deliso::oracle
