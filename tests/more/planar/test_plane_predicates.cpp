// SPDX-License-Identifier: MIT
// orient2d and incircle against integers of any width.
#include "more/planar/plane_predicates.h"

#include <doctest/doctest.h>

#include <array>

#include "base/random.h"
#include "exact/big_int.h"

using namespace deliso;

namespace {

using Points = std::array<Vec2, 4>;

oracle::BigVec3 to_integers(const Vec2& p, int unit) {
  return oracle::to_integers({p.x, p.y, 0}, unit);
}

int true_orient2d(const Vec2& a, const Vec2& b, const Vec2& c) {
  const int unit = oracle::common_unit({{a.x, a.y, 0}, {b.x, b.y, 0}, {c.x, c.y, 0}});
  const oracle::BigVec3 o = to_integers(a, unit);
  return cross(to_integers(b, unit) - o, to_integers(c, unit) - o).z.sign();
}

int true_incircle(const Points& p) {
  const int unit = oracle::common_unit(
      {{p[0].x, p[0].y, 0}, {p[1].x, p[1].y, 0}, {p[2].x, p[2].y, 0}, {p[3].x, p[3].y, 0}});
  const oracle::BigVec3 o = to_integers(p[3], unit);
  const oracle::BigVec3 a = to_integers(p[0], unit) - o, b = to_integers(p[1], unit) - o,
                        c = to_integers(p[2], unit) - o;
  return (dot(a, a) * cross(b, c).z + dot(b, b) * cross(c, a).z + dot(c, c) * cross(a, b).z).sign();
}

double step(Random& random, double x) {
  const auto k = random.below(3);
  return k == 0 ? x : std::nextafter(x, k == 1 ? 1e300 : -1e300);
}

double integer(Random& random, std::uint32_t range) {
  return static_cast<double>(random.below(2 * range + 1)) - range;
}

Points draw(Random& random, int trial) {
  Points p;
  const double scale = std::ldexp(1, static_cast<int>(random.below(120)) - 60);
  const Vec2 o{random.uniform(-1, 1), random.uniform(-1, 1)};
  const Vec2 u{random.uniform(-1, 1), random.uniform(-1, 1)};
  const double radius = random.uniform(0, 1);
  for (Vec2& q : p) {
    switch (trial % 6) {
      case 0:
        q = {scale * random.uniform(-1, 1), scale * random.uniform(-1, 1)};
        break;
      case 1:  // a small grid: on lines and circles more often than not
        q = {scale * integer(random, 2), scale * integer(random, 2)};
        break;
      case 2: {  // almost on one line
        const double t = random.uniform(-2, 2);
        q = {step(random, o.x + t * u.x), step(random, o.y + t * u.y)};
        break;
      }
      case 3: {  // almost on one circle
        const double angle = random.uniform(0, 6.28);
        q = {step(random, o.x + radius * std::cos(angle)),
             step(random, o.y + radius * std::sin(angle))};
        break;
      }
      case 4: {  // exactly on one: 5^2 + 0^2, 3^2 + 4^2, 7^2 + 24^2 ... of radius 65
        constexpr double kLegs[][2] = {{65, 0}, {63, 16}, {60, 25}, {56, 33}, {52, 39}};
        const auto& leg = kLegs[random.below(5)];
        q = {random.below(2) ? leg[0] : -leg[0], random.below(2) ? leg[1] : -leg[1]};
        if (random.below(2)) q = {q.y, q.x};
        q = {q.x + 1000, q.y - 2000};
        if (random.below(8) == 0) q.x = step(random, q.x);
        break;
      }
      default:
        q = {std::ldexp(random.uniform(-1, 1), static_cast<int>(random.below(190)) - 95),
             std::ldexp(random.uniform(-1, 1), static_cast<int>(random.below(190)) - 95)};
    }
  }
  return p;
}

}  // namespace

TEST_CASE("orient2d and incircle have the true sign, and flip it with two arguments") {
  Random random(41);
  int zeros = 0, wrong = 0;
  for (int trial = 0; trial < 300'000; ++trial) {
    const Points p = draw(random, trial);
    const int turn = orient2d(p[0], p[1], p[2]), in = incircle(p[0], p[1], p[2], p[3]);
    wrong += turn != true_orient2d(p[0], p[1], p[2]);
    wrong += in != true_incircle(p);
    wrong += orient2d(p[1], p[0], p[2]) != -turn;
    wrong += incircle(p[1], p[0], p[2], p[3]) != -in;
    zeros += (turn == 0) + (in == 0);
  }
  CHECK(wrong == 0);
  CHECK(zeros > 10'000);
}
