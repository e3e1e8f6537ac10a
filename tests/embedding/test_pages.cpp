// SPDX-License-Identifier: MIT
#include "embedding/pages.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "base/random.h"

using namespace deliso;

TEST_CASE("pages are in order as their angles are, seen from the end of the edge") {
  Random random(3);
  for (int n = 0; n < 2000; ++n) {
    const Vec3 a{random.uniform(), random.uniform(), random.uniform()}, b = a + Vec3{0, 0, 1};
    std::array<double, 3> angle;
    std::array<Vec3, 3> apex;
    for (std::size_t k = 0; k < 3; ++k) {
      angle[k] = 2 * std::numbers::pi * random.uniform();
      apex[k] = a + Vec3{std::cos(angle[k]), std::sin(angle[k]), 3 * random.uniform() - 1};
    }
    const auto after = [&](std::size_t k) {
      const double turn = angle[k] - angle[0];
      return turn < 0 ? turn + 2 * std::numbers::pi : turn;
    };
    CHECK(are_in_order(a, b, apex[0], apex[1], apex[2]) == (after(1) < after(2)));
    CHECK(cosine_of_pages(a, b, apex[0], apex[1]) ==
          doctest::Approx(std::cos(angle[1] - angle[0])));
  }
  const Vec3 a{0, 0, 0}, b{0, 0, 2};
  CHECK(cosine_of_pages(a, b, {1, 0, 0}, {3, 0, 1}) == 1);
  CHECK(cosine_of_pages(a, b, {1, 0, 5}, {-1, 0, 0}) == -1);
}
