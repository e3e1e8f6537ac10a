// SPDX-License-Identifier: MIT
#include "base/elementary.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace deliso {
namespace {

// kInverseFactorial[n] = 1 / n!
constexpr auto kInverseFactorial = [] {
  std::array<double, 20> inverse{};
  double factorial = 1;  // exact up to 18!
  for (std::size_t n = 0; n < inverse.size(); ++n) {
    factorial *= n > 0 ? static_cast<double>(n) : 1;
    inverse[n] = 1 / factorial;
  }
  return inverse;
}();

// Returns the multiple of a unit that is nearest to x, as a count. `per_unit` is 1 / unit.
double nearest_multiple(double x, double per_unit) {
  return std::floor(x * per_unit + 0.5);
}

// Returns 1/n! - r2/(n+2)! + r2^2/(n+4)! - ..., for r2 <= (pi/4)^2: exact to 2^-57 for n <= 1.
double alternating_series(double r2, std::size_t n) {
  std::size_t term = n + 16;
  double sum = kInverseFactorial[term];
  while (term > n) {
    term -= 2;
    sum = kInverseFactorial[term] - r2 * sum;
  }
  return sum;
}

// An angle = quarters * pi/2 + rest, |rest| <= pi/4.
struct ReducedAngle {
  int quarter;  // of the turn, 0 to 3
  double rest;
};

ReducedAngle reduced(double x) {
  // pi/2 in three parts. The first two have 33 bits, so that multiples up to 2^20 are exact.
  constexpr double kHigh = 0x1.921fb544p+0, kMiddle = 0x1.0b4611a6p-34,
                   kLow = 0x1.3198a2e037073p-69, kQuartersPerRadian = 0x1.45f306dc9c883p-1;
  const double n = nearest_multiple(x, kQuartersPerRadian);
  const double rest = ((x - n * kHigh) - n * kMiddle) - n * kLow;
  return {static_cast<int>(static_cast<long long>(n) & 3), rest};
}

double sine_of(const ReducedAngle& angle) {
  const double r2 = angle.rest * angle.rest;
  const double size =
      angle.quarter % 2 == 0 ? angle.rest * alternating_series(r2, 1) : alternating_series(r2, 0);
  return angle.quarter < 2 ? size : -size;
}

}  // namespace

double exponential(double x) {
  // ln 2 in two parts. The first has 32 bits, so that its multiples are exact.
  constexpr double kHigh = 0x1.62e42feep-1, kLow = 0x1.a39ef35793c76p-33,
                   kDoublingsPerUnit = 0x1.71547652b82fep+0;
  const double n = nearest_multiple(x, kDoublingsPerUnit);
  const double rest = (x - n * kHigh) - n * kLow;
  // |rest| <= ln(2) / 2: the terms left out are below 2^-60.
  double sum = 0;
  for (std::size_t term = 15; term-- > 0;) sum = kInverseFactorial[term] + rest * sum;
  return std::ldexp(sum, static_cast<int>(n));
}

double sine(double x) {
  return sine_of(reduced(x));
}

double cosine(double x) {
  const ReducedAngle angle = reduced(x);
  return sine_of({(angle.quarter + 1) % 4, angle.rest});
}

double cube_root(double x) {
  if (x == 0 || !std::isfinite(x)) return x;
  int exponent = 0;
  double m = std::frexp(std::abs(x), &exponent);
  // |x| = m 8^k, m from 1/8 to 1
  const int k = static_cast<int>(std::floor((exponent + 2) / 3.0));
  m = std::ldexp(m, exponent - 3 * k);
  // A chord within 8 %, then two steps of Halley's, which cube the relative error: 4e-4, 3e-11.
  double y = 0.45 + 0.57 * m;
  for (int step = 0; step < 2; ++step) {
    const double cube = y * y * y;
    y *= (cube + 2 * m) / (2 * cube + m);
  }
  y -= (y * y * y - m) / (3 * y * y);  // Newton's step adds less rounding
  return std::copysign(std::ldexp(y, k), x);
}

}  // namespace deliso
