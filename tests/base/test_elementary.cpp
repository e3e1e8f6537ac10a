// SPDX-License-Identifier: MIT
// The functions against the system's in long double, and their bits.
#include "base/elementary.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/random.h"

using namespace deliso;

namespace {

struct Outcome {
  double units;        // largest error, in units in the last place
  std::uint64_t bits;  // of all values, mixed in order
};

template <class F, class Exact>
Outcome try_out(F f, Exact exact, double lo, double hi) {
  constexpr int kArguments = 100'000;
  Random random(1);
  Outcome outcome{};
  for (int n = 0; n < kArguments; ++n) {
    const double x = random.uniform(lo, hi), y = f(x);
    const long double expected = exact(static_cast<long double>(x));
    const long double unit = std::ldexp(1.0L, std::ilogb(expected) - 52);
    outcome.units = std::max(outcome.units, static_cast<double>(std::abs(y - expected) / unit));
    outcome.bits = (outcome.bits ^ std::bit_cast<std::uint64_t>(y)) * 0x9e3779b97f4a7c15u;
    outcome.bits ^= outcome.bits >> 29;
  }
  return outcome;
}

}  // namespace

TEST_CASE("elementary functions are accurate, and the same bits on every machine") {
  struct Row {
    double (*own)(double);
    long double (*exact)(long double);
    double lo, hi;
    std::uint64_t bits;
  };
  const auto exp_of = [](long double x) { return std::exp(x); };
  const auto sin_of = [](long double x) { return std::sin(x); };
  const auto cos_of = [](long double x) { return std::cos(x); };
  const auto cbrt_of = [](long double x) { return std::cbrt(x); };
  const Row rows[] = {{exponential, exp_of, -1, 1, 0x5e8230275a378204u},
                      {exponential, exp_of, -700, 700, 0xc615e3ea603c8a7bu},
                      {sine, sin_of, -1, 1, 0xd8348d275897c706u},
                      {sine, sin_of, -40, 40, 0xdfd1d8fecc74879bu},
                      {sine, sin_of, -0x1p20, 0x1p20, 0x205c4dfefa01da86u},
                      {cosine, cos_of, -1, 1, 0x6894db8e942404f0u},
                      {cosine, cos_of, -40, 40, 0x7ea39a2e847c0d74u},
                      {cosine, cos_of, -0x1p20, 0x1p20, 0x1966205ed25ff537u},
                      {cube_root, cbrt_of, -1, 1, 0x943768c6eaebff42u},
                      {cube_root, cbrt_of, -1e300, 1e300, 0x362adf0452bc54bcu},
                      {cube_root, cbrt_of, 0, 1e-310, 0x524be721e2c9c508u}};
  for (const Row& row : rows) {
    CAPTURE(&row - rows);
    const Outcome outcome = try_out(row.own, row.exact, row.lo, row.hi);
    CHECK(outcome.units < 3);
    CHECK(outcome.bits == row.bits);
  }
}

TEST_CASE("elementary functions where the value is known") {
  CHECK(exponential(0) == 1);
  CHECK(sine(0) == 0);
  CHECK(cosine(0) == 1);
  for (double root = -20; root <= 20; ++root) CHECK(cube_root(root * root * root) == root);
  CHECK(std::signbit(cube_root(-0.0)));
  CHECK(cube_root(std::numeric_limits<double>::infinity()) ==
        std::numeric_limits<double>::infinity());
  // Multiples of pi/2 in double precision: the value is what the rounding of the angle leaves.
  CHECK(sine(0x1.921fb54442d18p+1) == 0x1.1a62633145c07p-53);
  CHECK(cosine(0x1.921fb54442d18p+0) == 0x1.1a62633145c07p-54);
  CHECK(cosine(-0x1.921fb54442d18p+2) == 1);
}
