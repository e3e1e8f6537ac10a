// SPDX-License-Identifier: MIT
// insphere for one point and two cells at once. The operations are those for one cell, each on two
// numbers side by side, which common processors do in one instruction. The compiler's vectors
// (GCC's, known to clang) round as doubles do, so the results are the same.
#pragma once

#include <array>

#include "delaunay/predicates.h"

namespace deliso {

namespace predicates {

using Pair = double __attribute__((vector_size(2 * sizeof(double))));

struct Vec3Pair {
  Pair x, y, z;

  static Vec3Pair difference(const Vec3& first, const Vec3& second, const Vec3Pair& p) {
    return {Pair{first.x, second.x} - p.x, Pair{first.y, second.y} - p.y,
            Pair{first.z, second.z} - p.z};
  }
  friend Pair dot(const Vec3Pair& a, const Vec3Pair& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
};

// A bound that needs no magnitudes of single coordinates. Let S be the sum of all squared lengths.
// The largest coordinates have mx^2 + my^2 + mz^2 <= S, hence mx my mz <= (S / 3)^1.5. So the scale
// of insphere_scale is at most S^2.5 / sqrt(27); squared, this needs no root. A determinant that
// underflows has a square below kSquareUnderflow, and its sign is uncertain.
inline constexpr double kInsphereSquaredFilter = kInsphereFilter * kInsphereFilter / 27;
inline constexpr double kSquareUnderflow = 0x1p-900;

}  // namespace predicates

// True for each of two cells, given by their corners, if p is strictly inside its circumsphere.
// pre: as for insphere.
inline std::array<bool, 2> inside_spheres(const std::array<const Vec3*, 4>& first,
                                          const std::array<const Vec3*, 4>& second, const Vec3& p) {
  using namespace predicates;
  const Vec3Pair e{{p.x, p.x}, {p.y, p.y}, {p.z, p.z}};
  const auto difference = [&](int i) { return Vec3Pair::difference(*first[i], *second[i], e); };
  const Vec3Pair a = difference(0), b = difference(1), c = difference(2), d = difference(3);
  const Pair det = insphere_determinant(a, b, c, d);
  const Pair s = (dot(a, a) + dot(b, b)) + (dot(c, c) + dot(d, d));
  const auto sure = det * det > kInsphereSquaredFilter * (s * s) * (s * s) * s + kSquareUnderflow;
  const auto inside = [&](int lane, const std::array<const Vec3*, 4>& v) {
    return sure[lane] ? det[lane] > 0 : insphere(*v[0], *v[1], *v[2], *v[3], p) > 0;
  };
  return {inside(0, first), inside(1, second)};
}

}  // namespace deliso
