// SPDX-License-Identifier: MIT
#include "more/planar/plane_predicates.h"

#include "exact/expansion.h"

namespace deliso::predicates {
namespace {

// Returns det[b-a, c-a], from the minors of the points themselves.
Expansion<12> turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (determinant(a.x, b.x, a.y, b.y) + determinant(b.x, c.x, b.y, c.y)) +
         determinant(c.x, a.x, c.y, a.y);
}

// e * |p|^2
Expansion<96> lifted(const Expansion<12>& e, const Vec2& p) {
  return e * p.x * p.x + e * p.y * p.y;
}

}  // namespace

int orient2d_exact(const Vec2& a, const Vec2& b, const Vec2& c) {
  return turn(a, b, c).sign();
}

// The 4 x 4 determinant of the lifted points, expanded by the column of squared lengths.
int incircle_exact(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return ((lifted(turn(b, c, d), a) - lifted(turn(a, c, d), b)) +
          (lifted(turn(a, b, d), c) - lifted(turn(a, b, c), d)))
      .sign();
}

}  // namespace deliso::predicates
