// SPDX-License-Identifier: MIT
// The predicates need every product rounded by itself. A compiler that fuses a * b + c into one
// operation breaks error terms, and with them every sign that is close. The flag -ffp-contract=off
// forbids it. These cases fail if the flag got lost and the machine fuses.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/random.h"

using namespace deliso;

namespace {

// Called through volatile pointers, so that the compiler computes nothing; it may still fuse
// within.
double (*volatile product_plus)(double, double, double) = [](double a, double b, double c) {
  return a * b + c;
};
double (*volatile cross_product)(double, double, double, double) =
    [](double a, double b, double c, double d) { return a * d - b * c; };
double (*volatile product)(double, double) = [](double a, double b) { return a * b; };
double (*volatile sum)(double, double) = [](double a, double b) { return a + b; };

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

double random_double(Random& random) {
  return std::ldexp(random.uniform(1, 2), static_cast<int>(random.below(40)) - 20) *
         (random.below(2) ? 1 : -1);
}

}  // namespace

TEST_CASE("a product is rounded before something is added to it") {
  // (1 + e)^2 = 1 + 2e + e^2 rounds to 1 + 2e. Fused, subtracting that leaves e^2.
  const double e = std::ldexp(1, -30), x = 1 + e, rounded = 1 + 2 * e;
  CHECK(std::fma(x, x, -rounded) == e * e);
  CHECK(product_plus(x, x, -rounded) == 0);
  CHECK(cross_product(x, 1, rounded, x) == 0);
  // Of parallel vectors: one fused operation rounds it one way, the other the other way.
  CHECK(cross_product(0.1, 0.1, 0.3, 0.3) == 0);

  Random random(1);
  int would_differ = 0;
  for (int n = 0; n < 100000; ++n) {
    const double a = random_double(random), b = random_double(random), p = product(a, b);
    const double c = random.below(2) ? -p : random_double(random);
    would_differ += !same_bits(std::fma(a, b, c), sum(p, c));
    REQUIRE(same_bits(product_plus(a, b, c), sum(p, c)));
  }
  CHECK(would_differ > 30000);
}

TEST_CASE("sums and products have the precision of a double, no more") {
  const double half_ulp = std::numeric_limits<double>::epsilon() / 2;
  CHECK(sum(sum(1, half_ulp), half_ulp) == 1);
  CHECK(sum(product(1 + 4 * half_ulp, 1 + 4 * half_ulp), -1) == 8 * half_ulp);
}
