// SPDX-License-Identifier: MIT
#include "view/render/layout.h"

#include <doctest/doctest.h>

#include "base/check.h"

using namespace deliso;

TEST_CASE("strips, panels and rules fill a picture and do not overlap") {
  for (const int width : {200, 641, 1600, 9933}) {
    for (const int height : {150, 1200, 14043}) {
      for (const std::size_t panels : {1u, 2u, 5u}) {
        for (const bool captions : {false, true}) {
          for (const bool bar : {false, true}) {
            const Layout layout = lay_out({width, height}, panels, captions, bar);
            CHECK((layout.captions > 0) == captions);
            CHECK((layout.bar > 0) == bar);
            CHECK(layout.captions + layout.panel.height + layout.bar == height);
            CHECK(layout.left(0) == 0);
            const int end = layout.left(panels - 1) + layout.panel.width;
            CHECK(end <= width);
            CHECK(end + static_cast<int>(panels) > width);
          }
        }
      }
    }
  }
}

TEST_CASE("a print looks like the screen: lines and text grow with the picture") {
  const Layout screen = lay_out({1600, 1200}, 2, true, true);
  const Layout print = lay_out({16000, 12000}, 2, true, true);
  CHECK(print.text == doctest::Approx(10 * screen.text));
  CHECK(print.line == doctest::Approx(10 * screen.line));
  CHECK(print.rule == doctest::Approx(10 * screen.rule).epsilon(0.2));
  CHECK(print.captions == doctest::Approx(10 * screen.captions).epsilon(0.02));
  CHECK(print.bar == doctest::Approx(10 * screen.bar).epsilon(0.02));
  // Down to what can be read and seen.
  const Layout small = lay_out({200, 150}, 2, true, true);
  CHECK(small.text == 8);
  CHECK(small.line == 0.9);
  CHECK(small.rule == 2);
}

TEST_CASE("a picture too small for its parts is refused") {
  CHECK(lay_out({8, 5}, 3, false, false).panel.width == 1);
  CHECK(lay_out({7, 5}, 3, false, false).panel.width == 1);
  CHECK_THROWS_AS(lay_out({6, 5}, 3, false, false), InputError);
  CHECK(lay_out({1, 1}, 1, false, false).panel.width == 1);
  CHECK_THROWS_WITH_AS(lay_out({100, 20}, 1, true, false),
                       "a picture 20 pixels high has no room for labels", InputError);
  CHECK_THROWS_WITH_AS(lay_out({100, 30}, 1, false, true),
                       "a picture 30 pixels high has no room for a color bar", InputError);
  CHECK(lay_out({100, 22}, 1, true, false).panel.height == 1);
}

TEST_CASE("a caption keeps within its panel, however long it is") {
  const Layout layout = lay_out({404, 300}, 2, true, false);
  const Rgb paper{255, 255, 255};
  for (const std::size_t length : {1u, 10u, 100u, 1000u}) {
    Image image(404, 300, paper);
    draw_caption(image, layout, 1, std::string(length, 'W'), {0, 0, 0});
    int inked = 0;
    for (int y = 0; y < 300; ++y) {
      for (int x = 0; x < 404; ++x) {
        if (image.at(x, y) == paper) continue;
        ++inked;
        REQUIRE(y < layout.captions);
        REQUIRE(x >= layout.left(1));
      }
    }
    CHECK(inked > 10);
  }
}
