// SPDX-License-Identifier: MIT
// orient3d and insphere against integers of any width.
#include "cases.h"
#include "exact/predicates.h"

#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "base/random.h"
#include "exact/big_int.h"

using namespace deliso;

namespace {

const int kCases = test::costly_cases(300'000);

// x moved by k steps to the next double.
double step(double x, int k) {
  for (; k > 0; --k) x = std::nextafter(x, 1e300);
  for (; k < 0; ++k) x = std::nextafter(x, -1e300);
  return std::fabs(x) < kSmallestCoordinate ? 0 : x;
}

int within(Random& random, int k) {
  return static_cast<int>(random.below(2 * k + 1)) - k;
}

Vec3 jitter(Random& random, Vec3 p, int k) {
  return {step(p.x, within(random, k)), step(p.y, within(random, k)), step(p.z, within(random, k))};
}

Vec3 in_cube(Random& random) {
  return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}

Vec3 integers(Random& random, int k) {
  return {double(within(random, k)), double(within(random, k)), double(within(random, k))};
}

// Magnitudes from 10^-30 to 10^30, each coordinate its own.
Vec3 any_magnitude(Random& random) {
  const auto coordinate = [&] { return random.uniform(-1, 1) * std::ldexp(1, within(random, 99)); };
  return {coordinate(), coordinate(), coordinate()};
}

Vec3 permuted(Random& random, Vec3 p) {
  for (int k = 0; k < 3; ++k) {
    std::swap(p[k], p[static_cast<int>(random.below(3))]);
    if (random.below(2)) p[k] = -p[k];
  }
  return p;
}

Vec3 scaled(const Vec3& p, int exponent) {
  return std::ldexp(1.0, exponent) * p;
}

using Points = std::array<Vec3, 5>;

// Families of inputs: random ones, and ones with a determinant that is zero or nearly zero.
Points random_points(Random& random, int trial) {
  Points p;
  const int kind = trial % 3, exponent = within(random, 99);
  for (Vec3& q : p) {
    q = kind == 0   ? in_cube(random)
        : kind == 1 ? scaled(in_cube(random), exponent)
                    : any_magnitude(random);
  }
  return p;
}

Points near_coplanar_points(Random& random, int trial) {
  Points p;
  const int exponent = within(random, 90);
  const Vec3 o = in_cube(random), u = in_cube(random), v = in_cube(random);
  const Vec3 io = integers(random, 1000), iu = integers(random, 20), iv = integers(random, 20);
  const int axis = static_cast<int>(random.below(3));
  const double level = random.uniform(-1, 1);
  for (Vec3& q : p) {
    switch (trial % 6) {
      case 0:  // a nextafter grid round points of one plane
        q = jitter(random, o + random.uniform(-2, 2) * u + random.uniform(-2, 2) * v, 2);
        break;
      case 1:  // exactly coplanar integers
        q = scaled(io + double(within(random, 20)) * iu + double(within(random, 20)) * iv,
                   exponent);
        break;
      case 2:  // the same, moved by an ulp here and there
        q = io + double(within(random, 20)) * iu + double(within(random, 20)) * iv;
        if (random.below(5) == 0) q = jitter(random, q, 1);
        break;
      case 3:  // one coordinate in common
        q = any_magnitude(random);
        q[axis] = random.below(8) == 0 ? step(level, 1) : level;
        break;
      case 4:  // a tiny set far from the origin
        q = jitter(random, Vec3{o.x + 100, o.y + 200, o.z - 300}, 4);
        break;
      default:  // on a line, or all but on it
        q = jitter(random, o + random.uniform(-2, 2) * u, 1);
    }
  }
  return p;
}

Points near_cospherical_points(Random& random, int trial) {
  if (trial % 4 == 3) return near_coplanar_points(random, trial / 4);
  Points p;
  const int exponent = within(random, 40);
  const Vec3 center = in_cube(random), icenter = integers(random, 100);
  const Vec3 seed = integers(random, 30);
  for (Vec3& q : p) {
    switch (trial % 4) {
      case 0: {  // rounded points of a sphere, moved by an ulp or two
        Vec3 n = in_cube(random);
        while (length2(n) < 0.01) n = in_cube(random);
        q = jitter(random, center + n / length(n), 2);
        break;
      }
      default: {  // integers with one squared length: a point's permutations and reflections
        q = scaled(permuted(random, seed) + icenter, exponent);
        if (trial % 4 == 2 && random.below(5) == 0) q = jitter(random, q, 1);
      }
    }
  }
  return p;
}

// The oracle's signs. They fail if a predicate, or its adaptive stages alone, have another one.
int orient3d_sign(const Points& p) {
  const int expected = oracle::orient3d(p[0], p[1], p[2], p[3]);
  if (orient3d(p[0], p[1], p[2], p[3]) != expected ||
      predicates::orient3d_adaptive(p[0], p[1], p[2], p[3]) != expected)
    FAIL("orient3d has another sign");
  return expected;
}
int insphere_sign(const Points& p) {
  const int expected = oracle::insphere(p[0], p[1], p[2], p[3], p[4]);
  if (insphere(p[0], p[1], p[2], p[3], p[4]) != expected ||
      predicates::insphere_adaptive(p[0], p[1], p[2], p[3], p[4]) != expected)
    FAIL("insphere has another sign");
  return expected;
}

// Counts each sign, so that no family is degenerate in the wrong way.
using SignCounts = std::array<int, 3>;

SignCounts count_signs(int (*sign)(const Points&), Points (*family)(Random&, int)) {
  SignCounts counts{};
  for (int trial = 0; trial < kCases; ++trial) {
    CAPTURE(trial);
    Random random(trial);
    ++counts[sign(family(random, trial)) + 1];
  }
  return counts;
}

}  // namespace

TEST_CASE("a positive cell and a point inside its sphere have sign 1") {
  const Vec3 o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  CHECK(orient3d(o, x, y, z) == 1);
  CHECK(orient3d(x, o, y, z) == -1);
  CHECK(orient3d(o, x, y, Vec3{5, 7, 0}) == 0);
  CHECK(orient3d_value(o, x, y, z) == 1.0);
  CHECK(insphere(o, x, y, z, Vec3{0.5, 0.5, 0.5}) == 1);
  CHECK(insphere(o, x, y, z, Vec3{2, 2, 2}) == -1);
  CHECK(insphere(o, x, y, z, Vec3{1, 1, 1}) == 0);
  CHECK(insphere(x, o, y, z, Vec3{0.5, 0.5, 0.5}) == -1);
}

TEST_CASE("orient3d has the exact sign on random points") {
  const SignCounts counts = count_signs(orient3d_sign, random_points);
  CHECK(counts[0] > kCases / 3);
  CHECK(counts[2] > kCases / 3);
}

TEST_CASE("orient3d has the exact sign on nearly coplanar points") {
  const SignCounts counts = count_signs(orient3d_sign, near_coplanar_points);
  for (int n : counts) CHECK(n > kCases / 8);
}

TEST_CASE("insphere has the exact sign on random points") {
  const SignCounts counts = count_signs(insphere_sign, random_points);
  CHECK(counts[0] > kCases / 5);
  CHECK(counts[2] > kCases / 5);
}

TEST_CASE("insphere has the exact sign on nearly cospherical points") {
  const SignCounts counts = count_signs(insphere_sign, near_cospherical_points);
  for (int n : counts) CHECK(n > kCases / 8);
}

namespace {

// The limits of predicates.cpp: insphere takes integers of up to 9 bits for short, orient3d of 16.
// The families above have fewer bits, or many more. Differences of coordinates have one bit more
// than the coordinates.

Vec3 of_bits(Random& random, int bits) {
  return integers(random, (1 << bits) - 1);
}

// Integers of `bits` bits with one squared length: generic ones, since permutations and reflections
// of one point often cancel without rounding.
std::vector<Vec3> cospherical_integers(Random& random, int bits, std::size_t count) {
  const Vec3 first = of_bits(random, bits);
  const double length2_of_all = length2(first);
  std::vector<Vec3> points{first};
  while (points.size() < count) {
    const double x = within(random, static_cast<int>(std::sqrt(length2_of_all)));
    const double rest = length2_of_all - x * x;
    for (double y = std::floor(std::sqrt(rest)); 2 * y * y >= rest; --y) {
      const double z = std::round(std::sqrt(rest - y * y));
      if (x * x + y * y + z * z != length2_of_all) continue;
      points.push_back({x, y, z});
      break;
    }
  }
  return points;
}

}  // namespace

TEST_CASE("insphere is exact on cospherical integers about the size where doubles round") {
  SignCounts counts{};
  for (int bits = 6; bits <= 14; ++bits) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      Random random(seed);
      const std::vector<Vec3> on_sphere = cospherical_integers(random, bits, 12);
      for (int trial = 0; trial < 250; ++trial) {
        CAPTURE(bits);
        CAPTURE(seed);
        CAPTURE(trial);
        Points p;
        for (Vec3& q : p) q = permuted(random, on_sphere[random.below(12)]);
        if (trial % 2) p[4][trial % 3] += within(random, 1);
        const int exponent = within(random, 40);
        for (Vec3& q : p) q = scaled(q, exponent);
        ++counts[insphere_sign(p) + 1];
      }
    }
  }
  for (int n : counts) CHECK(n > 2000);
}

TEST_CASE("orient3d is exact on coplanar integers about the size where doubles round") {
  SignCounts counts{};
  for (int bits = 12; bits <= 22; ++bits) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
      CAPTURE(bits);
      CAPTURE(seed);
      Random random(seed);
      // Vectors of `bits` bits: two, and their sum, which is in their plane.
      const Vec3 o = of_bits(random, bits), u = of_bits(random, bits - 1),
                 v = of_bits(random, bits - 1);
      Points p{o, o + u, o + v, o + (u + v)};
      if (seed % 2) p[3][static_cast<int>(seed % 3)] += within(random, 1);
      const int exponent = within(random, 90);
      for (Vec3& q : p) q = scaled(q, exponent);
      ++counts[orient3d_sign(p) + 1];
    }
  }
  for (int n : counts) CHECK(n > 2000);
}

TEST_CASE("signs are exact at both ends of the guaranteed range") {
  for (int trial = 0; trial < 20'000; ++trial) {
    CAPTURE(trial);
    Random random(trial);
    Points p = near_cospherical_points(random, trial);
    double largest = 0;
    for (const Vec3& q : p)
      for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::fabs(q[axis]));
    const int smallest_end = trial % 3 ? -130 : -139, end = trial % 2 ? 199 : smallest_end;
    for (Vec3& q : p) {
      q = scaled(q, end - std::ilogb(largest));
      for (int axis = 0; axis < 3; ++axis) {
        if (std::fabs(q[axis]) < kSmallestCoordinate) q[axis] = 0;
        REQUIRE(std::fabs(q[axis]) <= kLargestCoordinate);
      }
    }
    orient3d_sign(p);
    insphere_sign(p);
  }
}

TEST_CASE("orient3d: a walk over the nextafter grid around a coplanar point, in four even orders") {
  // After the best test of Shewchuk's ports: 64 x 64 neighboring doubles, in four even orders of
  // the points and an odd one.
  const Vec3 a{12, 12, 12}, b{24, 24, 24.5}, c{0.5, 0.5, 1}, base{0.5, 0.5, 0.75};
  int zeros = 0;
  double x = base.x;
  for (int i = 0; i < 64; ++i, x = std::nextafter(x, 1)) {
    double y = base.y;
    for (int j = 0; j < 64; ++j, y = std::nextafter(y, 1)) {
      const Vec3 d{x, y, base.z};
      const int expected = oracle::orient3d(a, b, c, d);
      zeros += expected == 0;
      REQUIRE(orient3d(a, b, c, d) == expected);
      REQUIRE(orient3d(b, a, d, c) == expected);
      REQUIRE(orient3d(c, d, a, b) == expected);
      REQUIRE(orient3d(d, b, a, c) == expected);
      REQUIRE(orient3d(b, a, c, d) == -expected);
    }
  }
  CHECK(zeros == 64);
}

TEST_CASE("collinear is exact, and orient3d_value accurate for flat cells") {
  for (int trial = 0; trial < 100'000; ++trial) {
    CAPTURE(trial);
    Random random(trial);
    Points p = near_coplanar_points(random, trial);
    if (trial % 2) {
      const Vec3 o = integers(random, 1000), u = integers(random, 20);
      for (Vec3& q : p) q = o + double(within(random, 20)) * u;
      if (random.below(2)) p[2] = jitter(random, p[2], 1);
    }
    if (trial % 7 == 0) p = {p[0], scaled(p[0], 15), scaled(p[0], 30), p[3], p[4]};
    const int unit = oracle::common_unit({p[0], p[1], p[2], p[3]});
    const auto o = oracle::to_integers(p[0], unit);
    const auto n = cross(oracle::to_integers(p[1], unit) - o, oracle::to_integers(p[2], unit) - o);
    REQUIRE(collinear(p[0], p[1], p[2]) == (dot(n, n).sign() == 0));

    const auto exact = oracle::orient3d(p[0], p[1], p[2], p[3], unit).divided_by_power(-3 * unit);
    REQUIRE(std::fabs(orient3d_value(p[0], p[1], p[2], p[3]) - exact) <=
            2 * kEpsilon * std::fabs(exact));
  }
}
