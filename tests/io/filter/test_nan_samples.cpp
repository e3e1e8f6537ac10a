// SPDX-License-Identifier: MIT
#include "io/filter/nan_samples.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace deliso;

TEST_CASE("NaN samples get the value, and others stay as they are") {
  const double nan = std::nan("");
  const Grid grid = Grid({9, 2, 2}, {1, 2, 3}, SampleType::f64).part({3, 0, 0}, {2, 2, 2});
  const Volume volume =
      Volume::from_samples(grid, std::vector<double>{1, nan, 3, -nan, 5, 6, 7, nan});
  std::uint64_t count = 1;
  const Volume filled = without_nan(volume, -2.5, count);
  CHECK(count == 4);
  CHECK(filled.first() == Index3{3, 0, 0});
  CHECK(filled.spacing() == Vec3{1, 2, 3});
  const std::vector<double> wanted{1, -2.5, 3, -2.5, 5, 6, 7, -2.5};
  for (int n = 0; n < 8; ++n) {
    CHECK(filled.sample(n % 2, n / 2 % 2, n / 4) == wanted[static_cast<std::size_t>(n)]);
  }
  // Without any, nothing is copied.
  const auto address = [](const Volume& of) {
    return of.visit([](const auto* samples) { return static_cast<const void*>(samples); });
  };
  CHECK(address(without_nan(filled, 7, count)) == address(filled));
  const Volume whole = Volume::from_samples({2, 2, 2}, {1, 1, 1}, std::vector<int>(8, 4));
  CHECK(address(without_nan(whole, 7, count)) == address(whole));
  CHECK(count == 4);
  const float f = std::nanf("");
  const Volume floats = Volume::from_samples({2, 2, 2}, {1, 1, 1}, std::vector<float>(8, f));
  CHECK(without_nan(floats, 0.1, count).sample(1, 1, 1) == 0.1f);
  CHECK(count == 12);
  CHECK_THROWS_WITH_AS(value_range(floats, "a"),
                       "a: NaN sample at (0, 0, 0): --nan VALUE gives such samples a value",
                       InputError);
}
