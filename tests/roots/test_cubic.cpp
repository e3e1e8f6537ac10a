// SPDX-License-Identifier: MIT
// Both cubic solvers against a bisection oracle in long double: crossings are increasing in [0, 1],
// |p| is within rounding there, none is missed, and the side of the beginning is known.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/random.h"
#include "cases.h"
#include "roots/cubic.h"

using namespace deliso;

namespace {

// Power basis.
using Exact = std::array<long double, 4>;

Exact power_of(const Cubic& b) {
  const long double b0 = b[0], b1 = b[1], b2 = b[2], b3 = b[3];
  return {b0, 3 * (b1 - b0), 3 * (b0 - 2 * b1 + b2), (b3 - b0) + 3 * (b1 - b2)};
}

long double value(const Exact& c, long double t) {
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

double largest_of(const Cubic& b) {
  return std::max({std::abs(b[0]), std::abs(b[1]), std::abs(b[2]), std::abs(b[3])});
}

// The bound on |p| at a crossing, relative to the largest coefficient.
constexpr double kResidual = 2e-11;

// A few numbers, without the heap: there are a million oracle calls.
struct Few {
  std::array<long double, 8> at{};
  std::size_t count = 0;

  void push_back(long double x) { at[count++] = x; }
  std::size_t size() const { return count; }
  long double operator[](std::size_t n) const { return at[n]; }
  const long double* begin() const { return at.data(); }
  const long double* end() const { return at.data() + count; }
};

// Cuts [0, 1] at the derivative's roots and bisects each piece whose ends have different signs.
// Works on the polynomial's values only where they decide something.
class Oracle {
 public:
  explicit Oracle(const Cubic& b) : c_(power_of(b)) {
    ends_.push_back(0);
    add_critical();
    ends_.push_back(1);
    for (std::size_t n = 0; n + 1 < ends_.size(); ++n) {
      // At 0 and 1 the coefficients are the values, to the last bit.
      const long double f0 = n == 0 ? b[0] : value(c_, ends_[n]);
      const long double f1 = n + 2 == ends_.size() ? b[3] : value(c_, ends_[n + 1]);
      if ((f0 >= 0) != (f1 >= 0)) roots_.push_back(bisect(ends_[n], ends_[n + 1], f1 >= 0));
    }
  }

  const Few& roots() const { return roots_; }

  // The largest |p| between a and b: at one of them or at an extremum between.
  long double largest_between(long double a, long double b) const {
    if (a > b) std::swap(a, b);
    long double largest = std::max(std::abs(value(c_, a)), std::abs(value(c_, b)));
    for (const long double t : ends_)
      if (a < t && t < b) largest = std::max(largest, std::abs(value(c_, t)));
    return largest;
  }

 private:
  void add_critical() {
    const long double a = 3 * c_[3], b = c_[2], d = b * b - a * c_[1];
    if (d < 0) return;
    const long double q = -(b + std::copysign(std::sqrt(d), b));
    long double t[] = {q / a, c_[1] / q};
    if (t[1] < t[0]) std::swap(t[0], t[1]);
    for (const long double at : t)
      if (at > 0 && at < 1) ends_.push_back(at);
  }

  long double bisect(long double lo, long double hi, bool rising) const {
    while (true) {
      const long double middle = lo + (hi - lo) / 2;
      if (!(lo < middle && middle < hi)) return middle;
      ((value(c_, middle) >= 0) == rising ? hi : lo) = middle;
      // Below the doubles' resolution the value would not change the verdict.
      if (hi - lo < 0x1p-60L * std::max(std::abs(lo), std::abs(hi))) return middle;
    }
  }

  Exact c_;
  Few ends_, roots_;
};

// Returns the fault, or nullptr. `residual` grows to the largest |p| at a crossing, relative to
// `size`.
const char* fault_of(const Cubic& b, const Oracle& oracle, const Roots& found, double& residual) {
  const double size = largest_of(b);
  const Exact power = power_of(b);
  double before = 0;
  for (const double t : found) {
    if (!(before <= t && t <= 1)) return "not increasing in [0, 1]";
    const auto off = static_cast<double>(std::abs(value(power, t)));
    residual = std::max(residual, off / size);
    if (off > kResidual * size) return "not a root";
    before = t;
  }
  const Few& roots = oracle.roots();
  for (std::size_t n = 0; n < roots.size(); ++n) {
    const auto is_at = [&](long double t) {
      return oracle.largest_between(roots[n], t) <= kResidual * size;
    };
    if (std::any_of(found.begin(), found.end(), is_at)) continue;
    // Two adjacent crossings may be a touch by rounding.
    const bool is_touch =
        (n > 0 && is_at(roots[n - 1])) || (n + 1 < roots.size() && is_at(roots[n + 1]));
    if (!is_touch) return "a crossing was missed";
  }
  if ((found.count % 2 == 1) != ((b[0] >= 0) != (b[3] >= 0))) return "parity";
  if (found.count > 0 && found.leaves(0) != (b[0] >= 0)) return "the side of the beginning";
  return nullptr;
}

// Checks both methods; on failure says which case it was.
bool check_case(const Cubic& b, std::uint64_t seed, double& residual, std::uint64_t& found) {
  const Oracle oracle(b);
  const int other_count = crossings(b, CubicMethod::schwarze).count;
  for (const CubicMethod method : {CubicMethod::isolation, CubicMethod::schwarze}) {
    const Roots roots = crossings(b, method);
    found += static_cast<std::uint64_t>(roots.count);
    const char* broken = fault_of(b, oracle, roots, residual);
    if (!broken && roots.count != other_count) broken = "the methods differ";
    if (!broken) continue;
    const std::string fault = broken;
    CAPTURE(fault);
    CAPTURE(seed);
    CAPTURE(static_cast<int>(method));
    CAPTURE(b[0]);
    CAPTURE(b[1]);
    CAPTURE(b[2]);
    CAPTURE(b[3]);
    CAPTURE(roots.count);
    FAIL_CHECK("crossings() and the oracle differ");
    return false;
  }
  return true;
}

// From the power basis, rounded.
Cubic bernstein_of(const Cubic& c) {
  return {c[0], c[0] + c[1] / 3, c[0] + (2 * c[1] + c[2]) / 3, c[0] + c[1] + c[2] + c[3]};
}

// (t - r0)(t - r1)(t - r2) * scale
Cubic from_roots(double r0, double r1, double r2, double scale) {
  return {-scale * r0 * r1 * r2, scale * (r0 * r1 + r1 * r2 + r2 * r0), -scale * (r0 + r1 + r2),
          scale};
}

// In the power basis.
Cubic adversarial_case(Random& random) {
  const double r = random.uniform(-0.5, 1.5), s = random.uniform(-2, 3);
  const double mantissa = random.uniform(-1, 1);
  const double scale = std::ldexp(mantissa, static_cast<int>(random.below(60)) - 30);
  // Roots on a coarse grid make the coefficients exact, so the multiplicities are.
  const double grid_r = std::round(r * 64) / 64, grid_s = std::round(s * 64) / 64;
  const double close = std::ldexp(1.0, -static_cast<int>(random.below(56)));
  const double end = random.below(2);
  Cubic c{};
  switch (random.below(12)) {
    case 0:
      c = from_roots(r, r, s, scale);
      break;
    case 1:
      c = from_roots(grid_r, grid_r, grid_s, std::exp2(random.below(9)));
      break;
    case 2:
      c = from_roots(r, r, r, scale);
      break;
    case 3:
      c = from_roots(grid_r, grid_r, grid_r, 1);
      break;
    case 4:
      c = from_roots(r, r + close, s, scale);
      break;
    case 5:
      c = from_roots(r, r + close, r - close, scale);
      break;
    case 6:  // vanishing leading coefficients
      c = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
           random.uniform(-1, 1) * close * close};
      break;
    case 7:
      c = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1) * close * close,
           random.uniform(-1, 1) * close * close * close};
      break;
    case 8:  // a root at an end
      c = from_roots(end, grid_r, grid_s, 1);
      break;
    case 9:  // a double root at an end, and next to it
      c = from_roots(end + close * close, end, s, 1);
      break;
    case 10:  // touching by a hair
      c = from_roots(r, r, s, 1);
      c[0] += random.uniform(-1, 1) * close * close;
      break;
    default:  // quadratics and lines, exactly
      c = {grid_r * grid_r, -2 * grid_r, random.below(2) * 1.0, 0};
      break;
  }
  // One in eight has a coefficient of zero.
  if (random.below(8) == 0) c[random.below(4)] = 0;
  return c;
}

}  // namespace

TEST_CASE("random cubics: both solvers agree with bisection") {
  double residual = 0;
  std::uint64_t found = 0;
  const std::uint64_t kTrials = test::cases(500'000);
  for (std::uint64_t seed = 0; seed < kTrials; ++seed) {
    Random random(seed);
    Cubic b;
    for (double& a : b) a = random.uniform(-1, 1);
    // With b[3] = 0 there is a root at the end besides the crossing before it. Newton's method,
    // started on the chord, once stayed there: the count was right, the place wrong.
    if (seed % 8 == 0) b[random.below(4)] = 0;
    if (seed % 8 == 1) b[3 * random.below(2)] = -0.0;
    if (!check_case(b, seed, residual, found)) break;
  }
  MESSAGE("largest |p| / max |b| at a crossing: " << residual);
  CHECK(found > kTrials / 2);
}

TEST_CASE("adversarial cubics: double, triple, close, vanishing, at the ends") {
  double residual = 0;
  std::uint64_t found = 0;
  const std::uint64_t kTrials = test::cases(200'000);
  for (std::uint64_t seed = 0; seed < kTrials; ++seed) {
    Random random(seed);
    if (!check_case(bernstein_of(adversarial_case(random)), seed, residual, found)) break;
  }
  MESSAGE("largest |p| / max |b| at a crossing: " << residual);
  CHECK(found > kTrials / 2);
}
