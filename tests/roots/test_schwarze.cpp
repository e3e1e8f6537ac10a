// SPDX-License-Identifier: MIT
// Schwarze's closed form alone. crossings() uses its roots as guesses only, and mends wrong ones.
// Coefficients are integers, so that their discriminant, which tells the number of roots, is exact.
#include "roots/schwarze.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/random.h"

using namespace deliso;

namespace {

__extension__ typedef __int128 Wide;

std::int64_t integer_within(Random& random, int k) {
  return static_cast<std::int64_t>(random.below(static_cast<std::uint32_t>(2 * k + 1))) - k;
}

std::vector<double> sorted_roots(const Cubic& c) {
  const Roots roots = closed_form_roots(c);
  std::vector<double> sorted(roots.begin(), roots.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

// The cubic with these integer coefficients, c[0] first.
struct IntegerCubic {
  std::int64_t c[4];

  Cubic scaled(double by) const {
    return {by * double(c[0]), by * double(c[1]), by * double(c[2]), by * double(c[3])};
  }
  Wide discriminant() const {
    const Wide d = c[0], e = c[1], b = c[2], a = c[3];
    return 18 * a * b * e * d - 4 * b * b * b * d + b * b * e * e - 4 * a * e * e * e -
           27 * a * a * d * d;
  }
};

// (t - r)(t - r)(t - s)
IntegerCubic with_double_root(std::int64_t r, std::int64_t s) {
  return {{-r * r * s, r * r + 2 * r * s, -2 * r - s, 1}};
}

}  // namespace

TEST_CASE("the closed form has as many roots as the discriminant says, and they are the cubic's") {
  constexpr double kTolerance = 1e-9;
  int with_one = 0, with_three = 0, rising = 0;
  for (std::uint64_t seed = 0; seed < 100'000; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const int size = seed % 2 ? 12 : 1000;
    IntegerCubic cubic{};
    for (std::int64_t& c : cubic.c) c = integer_within(random, size);
    if (seed % 5 == 0) cubic.c[2] = 0;  // depressed already
    const Wide discriminant = cubic.discriminant();
    if (cubic.c[3] == 0 || discriminant == 0) continue;
    const Cubic c = cubic.scaled(std::exp2(integer_within(random, 30)));
    const std::vector<double> roots = sorted_roots(c);
    REQUIRE(roots.size() == (discriminant > 0 ? 3 : 1));
    // A bound of Cauchy's: no root is larger.
    const double bound =
        1 + std::max({std::abs(c[0]), std::abs(c[1]), std::abs(c[2])}) / std::abs(c[3]);
    double largest = 0;
    for (const double t : roots) {
      const double at[] = {c[0], c[1] * t, c[2] * t * t, c[3] * t * t * t};
      const double value = at[0] + at[1] + at[2] + at[3];
      const double size_of_terms = std::abs(c[3]) * bound * bound * bound;
      REQUIRE(std::abs(value) <= kTolerance * size_of_terms);
      largest = std::max(largest, std::abs(t));
    }
    REQUIRE(largest <= bound * (1 + kTolerance));
    with_one += roots.size() == 1;
    rising += roots.size() == 1 && 3 * cubic.c[3] * cubic.c[1] > cubic.c[2] * cubic.c[2];
    if (roots.size() == 1) continue;
    // Three roots are the three, and none is listed twice, if they make up the coefficients
    // (Vieta).
    ++with_three;
    const double r = roots[0], s = roots[1], t = roots[2];
    REQUIRE(std::abs(r + s + t + c[2] / c[3]) <= kTolerance * bound);
    REQUIRE(std::abs(r * s + s * t + t * r - c[1] / c[3]) <= kTolerance * bound * bound);
    REQUIRE(std::abs(r * s * t + c[0] / c[3]) <= kTolerance * bound * bound * bound);
  }
  // Cardano's case with and without critical points, and three real roots.
  CHECK(rising > 20'000);
  CHECK(with_one - rising > 10'000);
  CHECK(with_three > 10'000);
}

TEST_CASE("a double root and a triple root are listed once") {
  for (int r = -30; r <= 30; ++r) {
    // Steps of three: a third of each coefficient is an integer, and nothing is rounded.
    for (int s = r - 30; s <= r + 30; s += 3) {
      CAPTURE(r);
      CAPTURE(s);
      const IntegerCubic cubic = with_double_root(r, s);
      REQUIRE(cubic.discriminant() == 0);
      for (const double scale : {1.0, -1.0, 0x1p-20}) {
        const std::vector<double> roots = sorted_roots(cubic.scaled(scale));
        REQUIRE(roots.size() == (r == s ? 1 : 2));
        CHECK(roots.front() == doctest::Approx(std::min(r, s)).epsilon(1e-12));
        CHECK(roots.back() == doctest::Approx(std::max(r, s)).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("without a leading coefficient the closed form solves the quadratic, then the line") {
  // The largest coefficient is at most 20, of which 2^-40 is nothing, for |t| <= 1.
  for (const double leading : {0.0, 0x1p-40, -0x1p-40}) {
    for (int a = -20; a <= 20; ++a) {
      for (int b = -20; b <= 20; ++b) {
        for (int c = -20; c <= 20; ++c) {
          CAPTURE(a);
          CAPTURE(b);
          CAPTURE(c);
          const std::vector<double> roots =
              sorted_roots({double(c), double(b), double(a), leading});
          const int discriminant = b * b - 4 * a * c;
          const int expected = a != 0 ? (discriminant > 0) + (discriminant >= 0) : b != 0;
          // Among coefficients of zero the leading one is the largest: a cubic without others.
          if (a == 0 && b == 0 && c == 0) continue;
          REQUIRE(roots.size() == static_cast<std::size_t>(expected));
          for (const double t : roots) {
            REQUIRE(std::abs(a * t * t + b * t + c) <=
                    1e-12 * (std::abs(a) * t * t + std::abs(b * t) + std::abs(c)));
          }
          if (roots.size() == 2) REQUIRE(roots[0] < roots[1]);
        }
      }
    }
  }
  CHECK(sorted_roots({0, 0, 0, 0}).empty());
}

TEST_CASE("the guess is the root in the interval, else the end next to the nearest root") {
  Roots roots;
  for (const double t : {0.5, -3.0, 1.25}) roots.push(t);
  CHECK(guess_from(roots, 0, 1) == 0.5);
  CHECK(guess_from(roots, 1, 2) == 1.25);
  CHECK(guess_from(roots, 0.9, 1) == 1);
  CHECK(guess_from(roots, -2, 0) == 0);
  CHECK(guess_from(roots, -2.75, -1) == -2.75);
  CHECK(guess_from(Roots{}, 0, 1) == 0.5);
}
