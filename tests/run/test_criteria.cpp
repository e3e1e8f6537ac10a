// SPDX-License-Identifier: MIT
#include "run/criteria.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "base/random.h"
#include "refine/facet_queue.h"

using namespace deliso;

namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Criteria kLoose = [] {
  Criteria none;
  none.limits.values.fill(kInfinity);
  return none;
}();
}  // namespace

TEST_CASE("measures of a right triangle equal those computed by hand") {
  // A right triangle: circumcenter in the middle of its longest side.
  const FacetShape s = measure({0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {1.5, 2, 0.75});
  CHECK(s.r == doctest::Approx(2.5));
  CHECK(s.h == doctest::Approx(0.75));
  CHECK(s.l == doctest::Approx(3));
}

TEST_CASE("the obtuse corner is the one with a negative cosine") {
  Random random(5);
  std::array<int, 4> times{};
  for (int n = 0; n < 1000; ++n) {
    std::array<Vec3, 3> p;
    for (Vec3& q : p) q = {random.uniform(), random.uniform(), random.uniform()};
    int expected = 3;
    for (int i = 0; i < 3; ++i) {
      const Vec3 &at = p[i], &next = p[(i + 1) % 3], &previous = p[(i + 2) % 3];
      if (cosine_between(next - at, previous - at) < 0) expected = i;
    }
    CHECK(obtuse_corner(p[0], p[1], p[2]) == expected);
    ++times[expected];
  }
  CHECK(*std::ranges::min_element(times) > 100);
}

TEST_CASE("each condition alone makes a facet bad, and the floors excuse it") {
  const FacetShape s{2, 0.5, 0.8};  // h/r = 0.25, r/l = 2.5
  CHECK_FALSE(violation(s, kLoose) > 1);
  struct Case {
    Criteria passes, fails;
    double violation;
  };
  const auto with = [](auto change) {
    Criteria k = kLoose;
    change(k);
    return k;
  };
  const Case cases[] = {{with([](Criteria& k) { k[Criterion::h_over_r] = 0.26; }),
                         with([](Criteria& k) { k[Criterion::h_over_r] = 0.24; }), 0.25 / 0.24},
                        {with([](Criteria& k) { k[Criterion::r_over_l] = 2.6; }),
                         with([](Criteria& k) { k[Criterion::r_over_l] = 2.4; }), 2.5 / 2.4},
                        {with([](Criteria& k) { k[Criterion::distance] = 0.6; }),
                         with([](Criteria& k) { k[Criterion::distance] = 0.4; }), 0.5 / 0.4},
                        {with([](Criteria& k) { k[Criterion::radius] = 2.1; }),
                         with([](Criteria& k) { k[Criterion::radius] = 1.9; }), 2 / 1.9}};
  for (const Case& c : cases) {
    CHECK_FALSE(violation(s, c.passes) > 1);
    CHECK(violation(s, c.fails) > 1);
    // How badly: by what share the limit is passed.
    CHECK(violation(s, c.fails) == doctest::Approx(c.violation));
    Criteria small = c.fails;
    small.r_min = 2;
    small.shape_floor = 2;
    CHECK_FALSE(violation(s, small) > 1);
    // Each floor excuses its own criteria: r_min distance and size, shape_floor shape.
    const bool of_shape = c.fails[Criterion::r_over_l] < kInfinity;
    small.shape_floor = 0;
    CHECK((violation(s, small) > 1) == of_shape);
    small.r_min = 0;
    small.shape_floor = 2;
    CHECK((violation(s, small) > 1) != of_shape);
  }
}

TEST_CASE("the violation is that of the worst criterion; an infinite facet is bad") {
  const FacetShape s{2, 0.5, 0.8};
  Criteria k;
  k[Criterion::h_over_r] = 0.2;
  k[Criterion::r_over_l] = 2;
  k[Criterion::distance] = 0.4;
  k[Criterion::radius] = 1.5;
  CHECK(violation(s, k) == doctest::Approx(4.0 / 3));
  CHECK(worst_criterion(s, k) == Criterion::radius);
  // A facet of no area.
  k.r_min = k.shape_floor = 1;
  CHECK(violation({kInfinity, kInfinity, 0.5}, k) > 1);
}

TEST_CASE("the queue pops the worst facet first, each as it was set last") {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    FacetQueue queue;
    std::vector<double> violation(200, 0);
    for (int n = 0; n < 1000; ++n) {
      const FaceId f(random.below(200));
      violation[f] = std::exp2(random.uniform(-2, 6));
      queue.set(f, violation[f]);
    }
    std::size_t expected = 0, got = 0;
    for (const double v : violation) expected += v > 1;
    CHECK(queue.size() >= expected);
    double last = kInfinity;
    for (FaceId f = queue.pop(); f != kNoId; f = queue.pop()) {
      ++got;
      REQUIRE(violation[f] > 1);
      CHECK(violation[f] <= last);
      last = std::exchange(violation[f], 0);  // given out once
    }
    CHECK(got == expected);
    CHECK(queue.size() == 0);
  }
}

TEST_CASE("the queue takes any violation") {
  FacetQueue queue;
  queue.set(3, 2);
  queue.set(1, kInfinity);
  queue.set(2, 1e300);
  queue.set(0, 1);
  CHECK(queue.size() == 3);
  CHECK(queue.pop() == 1);
  CHECK(queue.pop() == 2);
  CHECK(queue.pop() == 3);
  CHECK(queue.pop() == kNoId);
}
