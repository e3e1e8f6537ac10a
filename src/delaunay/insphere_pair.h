// SPDX-License-Identifier: MIT
// insphere for one point and two cells at once: the same operations as for one cell, but each on
// two numbers side by side, which every processor of today does in one instruction. The compiler's
// vectors (GCC's, understood by clang) round as doubles do, so nothing else is different.
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

// A bound that needs no magnitudes of single coordinates. With S the sum of all squared lengths,
// the largest coordinates mx, my, mz have mx^2 + my^2 + mz^2 <= S, hence mx my mz <= (S / 3)^1.5,
// and the scale of insphere_scale is at most S^2.5 / sqrt(27). Squared, this needs no root. Squares
// of a determinant that underflow are below kSquareUnderflow, and then nothing is sure.
inline constexpr double kInsphereSquaredFilter = kInsphereFilter * kInsphereFilter / 27;
inline constexpr double kSquareUnderflow = 0x1p-900;

}  // namespace predicates

// Whether p is strictly inside the circumsphere of the first cell, and of the second, each given by
// its corners. pre: as for insphere.
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
