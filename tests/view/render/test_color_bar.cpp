// SPDX-License-Identifier: MIT
// Scales that end where a tick is, and maps that can be read.
#include "view/render/color_bar.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/text.h"
#include "base/vec3.h"
#include "view/render/color_map.h"

using namespace deliso;

TEST_CASE("a scale ends at its last tick, not far above the value it is made for") {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const double value = std::exp(random.uniform(-40, 40));
    const double hi = round_up(value);
    CHECK(hi >= 0.998 * value);
    CHECK(hi < 1.5 * value);
    CHECK(round_up(hi) == hi);
    const std::vector<double> ticks = ticks_up_to(hi);
    CHECK(ticks.size() >= 4);
    CHECK(ticks.size() <= 7);
    CHECK(ticks.front() == 0);
    CHECK(ticks.back() == hi);
    for (std::size_t n = 1; n < ticks.size(); ++n) {
      CHECK(ticks[n] - ticks[n - 1] == doctest::Approx(ticks[1]));
    }
  }
  CHECK(ticks_up_to(60) == std::vector<double>{0, 10, 20, 30, 40, 50, 60});
  CHECK(ticks_up_to(0.3) == std::vector<double>{0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3});
  CHECK(text(ticks_up_to(0.3)[3]) == "0.15");
  CHECK(round_up(0.187) == 0.2);
  CHECK(round_up(137) == 150);
}

namespace {

// CIE lightness of an sRGB color, 0 to 100.
double lightness(Rgb c) {
  const auto linear = [](std::uint8_t byte) {
    const double x = byte / 255.0;
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  };
  const double y = 0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue);
  return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

}  // namespace

TEST_CASE("the sequential map gets lighter evenly; its ends hold beyond them") {
  double least = 100, most = 0;
  for (int n = 0; n < 20; ++n) {
    const double step =
        lightness(sequential_color((n + 1) / 20.0)) - lightness(sequential_color(n / 20.0));
    least = std::min(least, step);
    most = std::max(most, step);
  }
  CHECK(least > 1.5);
  CHECK(most < 5);
  CHECK(sequential_color(-1) == sequential_color(0));
  CHECK(sequential_color(7) == sequential_color(1));
  CHECK(sequential_color(std::nan("")) == sequential_color(1));
}

// What a reader without red (protanopia) or green cones (deuteranopia) sees: Vienot, Brettel and
// Mollon 1999, as rows of linear light.
Vec3 seen_without(bool red, const Rgb& color) {
  const auto linear = [](int byte) {
    const double c = byte / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const double r = linear(color.red), g = linear(color.green), b = linear(color.blue);
  const double warm = red ? 0.11238 * r + 0.88762 * g : 0.29275 * r + 0.70725 * g;
  const double cold = red ? b + 0.00401 * (r - g) : b - 0.02234 * (r - g);
  return {std::cbrt(warm), std::cbrt(warm), std::cbrt(std::max(0.0, cold))};
}

TEST_CASE("kinds have colors that differ, also without red or green cones") {
  for (std::size_t a = 0; a < kCategories; ++a) {
    const Rgb p = category_color(a);
    CHECK(lightness(p) > 45);
    CHECK(lightness(p) < 92);
    for (std::size_t b = 0; b < a; ++b) {
      const Rgb q = category_color(b);
      CHECK(std::abs(p.red - q.red) + std::abs(p.green - q.green) + std::abs(p.blue - q.blue) > 60);
      for (const bool red : {true, false}) {
        CHECK(length(seen_without(red, p) - seen_without(red, q)) > 0.12);
      }
    }
  }
}

TEST_CASE("hundreds of kinds have different colors") {
  for (std::size_t a = 0; a < 250; ++a) {
    for (std::size_t b = 0; b < a; ++b) CHECK_FALSE(category_color(a) == category_color(b));
  }
}

TEST_CASE("the bar has the map's colors from left to right and a number at its ends") {
  const Layout layout = lay_out({1000, 400}, 1, false, true);
  const Rgb paper{255, 255, 255}, ink{0, 0, 0};
  Image image(1000, 400, paper);
  draw_color_bar(image, layout, {"angle (degrees)", 60, true}, ink);
  // The bar is the longest run of pixels other than paper.
  int begin = 0, end = 0;
  const int middle = 400 - layout.bar + static_cast<int>(1.2 * layout.text);
  for (int x = 0, start = 0; x < 1000; ++x) {
    if (image.at(x, middle) == paper) start = x + 1;
    if (x + 1 - start > end - begin) {
      begin = start;
      end = x + 1;
    }
  }
  REQUIRE(begin > 100);  // the title is to its left
  REQUIRE(end > begin + 100);
  for (int x = begin; x < end; ++x) {
    const Rgb expected = sequential_color((x + 0.5 - begin) / (end - begin));
    CHECK(std::abs(image.at(x, middle).green - expected.green) <= 4);
  }
  const auto has_ink = [&](int x0, int x1) {
    int count = 0;
    for (int y = 400 - static_cast<int>(2 * layout.text); y < 400; ++y) {
      for (int x = x0; x < x1; ++x) count += image.at(x, y).red < 100;
    }
    return count > 3;
  };
  CHECK(has_ink(begin - 5, begin + 5));
  CHECK(has_ink(end - 5, end + 5));
  // However long the title, all keeps within the picture.
  Image narrow(120, 400, paper);
  draw_color_bar(narrow, lay_out({120, 400}, 1, false, true), {std::string(300, 'm'), 0.2, false},
                 ink);
  for (int y = 0; y < 400; ++y) {
    CHECK(narrow.at(0, y) == paper);
    CHECK(narrow.at(119, y) == paper);
  }
}
