// SPDX-License-Identifier: MIT
// Both cubic solvers against a bisection oracle in long double, by the rules R1-R4 of the header.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/random.h"
#include "roots/cubic.h"

using namespace deliso;

namespace {

struct Case {
  Cubic c;
  double lo, hi;
};

long double value(const Cubic& c, long double t) {
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

// E of the header.
long double noise_bound(const Case& k) {
  const double reach = std::max(std::abs(k.lo), std::abs(k.hi));
  double w = 1;
  while (w < reach) w *= 2;
  while (w / 2 >= reach && w > 1e-300) w /= 2;
  long double sum = 0, power = 1;
  for (const double a : k.c) {
    sum += std::abs(static_cast<long double>(a)) * power;
    power *= w;
  }
  return static_cast<long double>(kRootNoise) * sum;
}

// A few numbers, without the heap: there are eleven million oracles.
struct Few {
  std::array<long double, 8> at{};
  std::size_t count = 0;

  void push_back(long double x) { at[count++] = x; }
  std::size_t size() const { return count; }
  long double operator[](std::size_t n) const { return at[n]; }
  long double front() const { return at[0]; }
  long double back() const { return at[count - 1]; }
  const long double* begin() const { return at.data(); }
  const long double* end() const { return at.data() + count; }
};

// The interval cut at the derivative's roots, and a root by bisection in each piece whose ends have
// different signs. Works on the polynomial's values only where they decide something.
class Oracle {
 public:
  explicit Oracle(const Case& k) : c_(k.c) {
    ends_.push_back(k.lo);
    add_critical(k.lo, k.hi);
    ends_.push_back(k.hi);
    for (std::size_t n = 0; n + 1 < ends_.size(); ++n) {
      const long double f0 = value(c_, ends_[n]), f1 = value(c_, ends_[n + 1]);
      if (f0 == 0) roots_.push_back(ends_[n]);
      if (f0 * f1 < 0) roots_.push_back(bisect(ends_[n], ends_[n + 1], f1 > 0));
    }
    if (value(c_, ends_.back()) == 0 && ends_.back() != ends_.front())
      roots_.push_back(ends_.back());
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
  void add_critical(long double lo, long double hi) {
    const long double a = 3.0L * c_[3], b = c_[2], d = b * b - a * c_[1];
    if (d < 0) return;
    const long double q = -(b + std::copysign(std::sqrt(d), b));
    long double t[] = {q / a, c_[1] / q};
    if (t[1] < t[0]) std::swap(t[0], t[1]);
    for (const long double at : t)
      if (at > lo && at < hi) ends_.push_back(at);
  }

  long double bisect(long double lo, long double hi, bool rising) const {
    while (true) {
      const long double middle = lo + (hi - lo) / 2;
      if (!(lo < middle && middle < hi)) return middle;
      ((value(c_, middle) > 0) == rising ? hi : lo) = middle;
      // Below the doubles' resolution the value would not change the verdict.
      if (hi - lo < 0x1p-60L * std::max(std::abs(lo), std::abs(hi))) return middle;
    }
  }

  Cubic c_;
  Few ends_, roots_;
};

// The first rule broken, or nullptr. `residual` grows to the largest |p| / E at a reported root.
const char* broken_rule(const Case& k, const Oracle& oracle, const Roots& found,
                        long double& residual) {
  const long double bound = noise_bound(k);
  if (bound == 0) return found.count == 0 ? nullptr : "a root of the zero polynomial";
  long double before = 0;
  for (int n = 0; n < found.count; ++n) {
    const double t = found.t[static_cast<std::size_t>(n)];
    if (!(k.lo <= t && t <= k.hi)) return "R4: root outside the interval";
    const long double f = std::abs(value(k.c, t));
    residual = std::max(residual, f / bound);
    if (f > bound) return "R1: not a root";
    if (n > 0 && !(t > before)) return "not increasing";
    if (n > 0 && oracle.largest_between(before, t) < bound / 4) return "R3: one root twice";
    before = t;
  }
  for (const long double root : oracle.roots()) {
    bool matched = false;
    for (const double t : found) matched |= oracle.largest_between(root, t) <= bound;
    if (!matched) return "R2: a root was missed";
  }
  return nullptr;
}

// Checks both methods; on failure says which case.
bool check_case(const Case& k, std::uint64_t seed, long double& residual, std::uint64_t& found) {
  const Oracle oracle(k);
  for (const CubicMethod method : {CubicMethod::isolation, CubicMethod::schwarze}) {
    const Roots roots = solve_cubic(k.c, k.lo, k.hi, method);
    found += static_cast<std::uint64_t>(roots.count);
    const char* broken = broken_rule(k, oracle, roots, residual);
    if (!broken) continue;
    const std::string rule = broken;
    CAPTURE(rule);
    CAPTURE(seed);
    CAPTURE(static_cast<int>(method));
    CAPTURE(k.c[0]);
    CAPTURE(k.c[1]);
    CAPTURE(k.c[2]);
    CAPTURE(k.c[3]);
    CAPTURE(k.lo);
    CAPTURE(k.hi);
    CAPTURE(roots.count);
    FAIL_CHECK("a rule of the header is broken");
    return false;
  }
  return true;
}

Case random_case(Random& random) {
  Case k{};
  for (double& a : k.c) a = random.uniform(-1, 1);
  if (random.below(4) == 0) {
    k.lo = random.uniform(-3, 3);
    k.hi = k.lo + random.uniform(0, 3);
  } else {
    k.lo = 0;
    k.hi = 1;
  }
  return k;
}

// (t - r0)(t - r1)(t - r2) * scale
Cubic from_roots(double r0, double r1, double r2, double scale) {
  return {-scale * r0 * r1 * r2, scale * (r0 * r1 + r1 * r2 + r2 * r0), -scale * (r0 + r1 + r2),
          scale};
}

Case adversarial_case(Random& random) {
  Case k{{}, 0, 1};
  const double r = random.uniform(-0.5, 1.5), s = random.uniform(-2, 3);
  const double mantissa = random.uniform(-1, 1), third = random.uniform();
  const double scale = std::ldexp(mantissa, static_cast<int>(random.below(60)) - 30);
  // Roots on a coarse grid make the coefficients exact, so the multiplicities are.
  const double grid_r = std::round(r * 64) / 64, grid_s = std::round(s * 64) / 64;
  const double close = std::ldexp(1.0, -static_cast<int>(random.below(56)));
  const double end = random.below(2);
  switch (random.below(14)) {
    case 0:
      k.c = from_roots(r, r, s, scale);
      break;
    case 1:
      k.c = from_roots(grid_r, grid_r, grid_s, std::exp2(random.below(9)));
      break;
    case 2:
      k.c = from_roots(r, r, r, scale);
      break;
    case 3:
      k.c = from_roots(grid_r, grid_r, grid_r, 1);
      break;
    case 4:
      k.c = from_roots(r, r + close, s, scale);
      break;
    case 5:
      k.c = from_roots(r, r + close, r - close, scale);
      break;
    case 6:  // vanishing leading coefficients
      k.c = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
             random.uniform(-1, 1) * close * close};
      break;
    case 7:
      k.c = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1) * close * close,
             random.uniform(-1, 1) * close * close * close};
      break;
    case 8:  // a root at an end
      k.c = from_roots(end, grid_r, grid_s, 1);
      break;
    case 9:
      k = {from_roots(r, s, third, scale), std::min(r, s), std::max(r, s)};
      break;
    case 10:  // a double root at an end, and next to it
      k.c = from_roots(end + close * close, end, s, 1);
      break;
    case 11:  // touching by a hair
      k.c = from_roots(r, r, s, 1);
      k.c[0] += random.uniform(-1, 1) * close * close;
      break;
    case 12:  // quadratics and lines, exactly
      k.c = {grid_r * grid_r, -2 * grid_r, random.below(2) * 1.0, 0};
      break;
    default:  // far from the unit interval
      k.lo = std::ldexp(s, static_cast<int>(random.below(80)) - 40);
      k.hi = k.lo + std::abs(k.lo) * third;
      k.c = from_roots(k.lo, k.lo + r * (k.hi - k.lo), k.lo + third * (k.hi - k.lo), scale);
      break;
  }
  // One in eight has a coefficient of zero.
  if (random.below(8) == 0) k.c[random.below(4)] = 0;
  return k;
}

}  // namespace

TEST_CASE("random cubics: both solvers agree with bisection") {
  long double residual = 0;
  std::uint64_t found = 0;
  constexpr std::uint64_t kTrials = 10'000'000;
  for (std::uint64_t seed = 0; seed < kTrials; ++seed) {
    Random random(seed);
    if (!check_case(random_case(random), seed, residual, found)) break;
  }
  MESSAGE("largest |p| / E at a root: " << static_cast<double>(residual));
  CHECK(found > kTrials / 2);
}

TEST_CASE("adversarial cubics: double, triple, close, vanishing, at the ends") {
  long double residual = 0;
  std::uint64_t found = 0;
  constexpr std::uint64_t kTrials = 1'000'000;
  for (std::uint64_t seed = 0; seed < kTrials; ++seed) {
    Random random(seed);
    if (!check_case(adversarial_case(random), seed, residual, found)) break;
  }
  MESSAGE("largest |p| / E at a root: " << static_cast<double>(residual));
  CHECK(found > kTrials / 2);
}

namespace {

double bernstein(const Cubic& b, double t) {
  const double u = 1 - t;
  return u * u * u * b[0] + 3 * u * t * (u * b[1] + t * b[2]) + t * t * t * b[3];
}

}  // namespace

// Story: with b[3] = 0 there is a root at the end besides the crossing before it, and Newton's
// method, started on the chord, stayed there. The count was right, the place wrong.
TEST_CASE("crossings are where the sign changes, and alternate") {
  std::uint64_t found = 0;
  double residual = 0;
  constexpr std::uint64_t kTrials = 1'000'000;
  for (std::uint64_t seed = 0; seed < kTrials; ++seed) {
    Random random(seed);
    Cubic b;
    const double close = std::ldexp(1.0, -static_cast<int>(random.below(60)));
    const std::uint32_t kind = random.below(7);
    for (double& a : b) a = random.uniform(-1, 1);
    if (kind == 1) b = {1, 1.0 / 3 - 2.0 / 3 + close * b[0], 1.0 / 3 - 2.0 / 3, 1};  // near a touch
    if (kind == 2) b = {b[0], close * b[1], close * b[2], close * b[3]};
    if (kind == 3) b[random.below(4)] = 0;
    if (kind == 4) b = {b[0], b[0] + close * b[1], b[0] - close * b[2], -b[0]};
    if (kind == 5) b[0] = -0.0;
    if (kind == 6) b[3 * random.below(2)] *= close;
    const double size = std::max({std::abs(b[0]), std::abs(b[1]), std::abs(b[2]), std::abs(b[3])});

    Roots by[2];
    for (const CubicMethod method : {CubicMethod::isolation, CubicMethod::schwarze}) {
      CAPTURE(seed);
      CAPTURE(static_cast<int>(method));
      const Roots roots = by[static_cast<std::size_t>(method)] = crossings(b, method);
      if ((roots.count % 2 == 1) != ((b[0] >= 0) != (b[3] >= 0))) FAIL("parity");
      double before = 0;
      for (const double t : roots) {
        if (!(before <= t && t <= 1)) FAIL("not increasing in [0, 1]");
        residual = std::max(residual, std::abs(bernstein(b, t)) / size);
        before = t;
      }
      found += static_cast<std::uint64_t>(roots.count);
      for (int n = 0; n < 8; ++n) {
        const double t = random.uniform(), f = bernstein(b, t);
        const auto passed =
            std::count_if(roots.begin(), roots.end(), [t](double root) { return root < t; });
        if (std::abs(f) > 1e-10 * size && ((f >= 0) != (b[0] >= 0)) != (passed % 2 == 1))
          FAIL("not where the sign changes");
      }
    }
    if (by[0].count != by[1].count) FAIL("the methods differ");
  }
  MESSAGE("largest |p| / max |b| at a crossing: " << residual);
  CHECK(residual <= 2e-11);
  CHECK(found > kTrials);
}
