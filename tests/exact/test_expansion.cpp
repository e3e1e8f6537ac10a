// SPDX-License-Identifier: MIT
// Expansion arithmetic against integers of any width, and its invariants X1 and X2.
#include "exact/expansion.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "base/random.h"
#include "exact/big_int.h"

using namespace deliso;
using oracle::BigInt;
using oracle::lowest_exponent;
using oracle::to_integer;

namespace {

constexpr int kUnit = -400;  // below every lowest bit that comes up here

double some_double(Random& random) {
  const int exponent = static_cast<int>(random.below(61)) - 30;
  switch (random.below(4)) {
    case 0:
      return static_cast<double>(random.below(17)) - 8;
    case 1:
      return std::ldexp(1.0, exponent);
    default:
      return std::ldexp(random.uniform(-1, 1), exponent);
  }
}

template <int N>
BigInt exact_value(const Expansion<N>& e) {
  BigInt value;
  for (int i = 0; i < e.size(); ++i) value = value + to_integer(e[i], kUnit);
  return value;
}

template <int N>
void check_invariants(const Expansion<N>& e) {
  for (int i = 0; i < e.size(); ++i) {
    REQUIRE(e[i] != 0);
    if (i > 0) REQUIRE(std::ilogb(e[i - 1]) < lowest_exponent(e[i], 0));
  }
}

}  // namespace

TEST_CASE("two_sum, two_product and their errors are exact") {
  // Also the self-test that the compiler fused or reordered nothing.
  for (int trial = 0; trial < 300'000; ++trial) {
    CAPTURE(trial);
    Random random(trial);
    const double a = some_double(random), b = some_double(random);
    const BigInt ia = to_integer(a, kUnit / 2), ib = to_integer(b, kUnit / 2);

    const TwoTerms product = two_product(a, b);
    REQUIRE(product.value == a * b);
    REQUIRE(
        (to_integer(product.value, kUnit) + to_integer(product.error, kUnit) - ia * ib).sign() ==
        0);
    const TwoTerms sum = two_sum(a, b);
    REQUIRE(sum.value == a + b);
    REQUIRE(
        (to_integer(sum.value, kUnit / 2) + to_integer(sum.error, kUnit / 2) - (ia + ib)).sign() ==
        0);
    const Halves halves = split(a);
    REQUIRE(halves.high + halves.low == a);
    REQUIRE(std::ldexp(halves.high, 26 - std::ilogb(a == 0 ? 1 : a)) ==
            std::rint(std::ldexp(halves.high, 26 - std::ilogb(a == 0 ? 1 : a))));
  }
}

TEST_CASE("sums and products of expansions are exact and keep X1 and X2") {
  int zeros = 0;
  for (int trial = 0; trial < 30'000; ++trial) {
    CAPTURE(trial);
    Random random(trial);
    double v[8];
    for (double& x : v) x = some_double(random);
    const BigInt i[8] = {to_integer(v[0], -100), to_integer(v[1], -100), to_integer(v[2], -100),
                         to_integer(v[3], -100), to_integer(v[4], -100), to_integer(v[5], -100),
                         to_integer(v[6], -100), to_integer(v[7], -100)};
    const auto at_unit = [](const BigInt& x, int degree) {
      return x.shifted_left(-kUnit - 100 * degree);
    };
    const auto expect = [&](const auto& e, const BigInt& exact) {
      check_invariants(e);
      REQUIRE((exact_value(e) - exact).sign() == 0);
      REQUIRE(e.sign() == exact.sign());
      const long double value = exact.divided_by_power(-kUnit);
      REQUIRE(std::fabs(e.estimate() - value) <= 0x1p-52 * std::fabs(value));
      zeros += exact.sign() == 0;
    };

    const auto d0 = determinant(v[0], v[1], v[2], v[3]), d1 = determinant(v[4], v[5], v[6], v[7]);
    const BigInt i0 = i[0] * i[3] - i[1] * i[2], i1 = i[4] * i[7] - i[5] * i[6];
    expect(d0, at_unit(i0, 2));
    expect(d0 + d1, at_unit(i0 + i1, 2));
    expect(d0 - d1, at_unit(i0 - i1, 2));
    expect(d0 - d0, BigInt());
    expect(d0 * v[4] + d1 * v[0], at_unit(i0 * i[4] + i1 * i[0], 3));
    expect(d0 * d1, at_unit(i0 * i1, 4));
    expect(d0 * v[1] - (d1 + d0) * v[2], at_unit(i0 * i[1] - (i1 + i0) * i[2], 3));
  }
  CHECK(zeros > 30'000);
}

// With NaN or infinities every error term is one of them; a sum once wrote one term behind its
// array.
TEST_CASE("NaN and infinities make no expansion longer than its type says") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const double values[] = {nan, infinity, -infinity, 1e308, 1, 0};
  for (const double a : values) {
    for (const double b : values) {
      for (const double c : values) {
        const Expansion<4> minor = determinant(a, b, c, 1e300);
        const Expansion<8> sum = minor + minor;
        const Expansion<8> product = minor * a;
        const auto both = (product + minor * b) * c - minor * nan;
        CHECK(minor.size() <= 4);
        CHECK(sum.size() <= 8);
        CHECK(product.size() <= 8);
        CHECK(both.size() <= 40);
        CHECK((minor * minor).size() <= 32);
      }
    }
  }
}
