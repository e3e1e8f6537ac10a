// SPDX-License-Identifier: MIT
// Every character is drawn, differs from all others, and keeps to its place.
#include "cases.h"
#include "view/render/font.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace deliso;

namespace {

constexpr Rgb kFontPaper{255, 255, 255}, kFontInk{0, 0, 0};

struct Drawn {
  double ink = 0;  // pixels
  int left = 1000, right = -1, top = 1000, bottom = -1;
  std::vector<Rgb> pixels;
};

// With the baseline at row 60, the left edge at column 40.
Drawn drawn(std::string_view text, double height) {
  Image image(400, 100, kFontPaper);
  draw_text(image, text, 40, 60, height, kFontInk);
  Drawn result;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double share = (255 - image.at(x, y).green) / 255.0;
      result.ink += share;
      if (share < 0.3) continue;
      result.left = std::min(result.left, x);
      result.right = std::max(result.right, x);
      result.top = std::min(result.top, y);
      result.bottom = std::max(result.bottom, y);
    }
  }
  result.pixels = image.pixels;
  return result;
}

}  // namespace

TEST_CASE("every glyph but the blank has ink, none is like another, at any size" *
          test::slow("all pairs of 95 glyphs are compared, pixel by pixel, at four sizes")) {
  for (const double height : {7.0, 8.0, 12.5, 30.0}) {
    std::vector<Drawn> glyphs;
    for (char c = kFirstGlyph; c <= kLastGlyph; ++c) glyphs.push_back(drawn({&c, 1}, height));
    CHECK(glyphs[0].ink == 0);
    for (std::size_t a = 1; a < glyphs.size(); ++a) {
      CAPTURE(a);
      CHECK(glyphs[a].ink > 0.01 * height * height);
      CHECK(glyphs[a].ink < 0.8 * height * height);
      for (std::size_t b = 0; b < a; ++b) {
        const double least = 0.008 * height * height;
        double difference = 0;
        for (std::size_t n = 0; n < glyphs[a].pixels.size() && difference <= least; ++n) {
          difference += std::abs(glyphs[a].pixels[n].green - glyphs[b].pixels[n].green) / 255.0;
        }
        CAPTURE(b);
        CHECK(difference > least);
      }
    }
  }
}

TEST_CASE("glyphs stand on the baseline, as high and as wide as is said") {
  for (const double height : {9.0, 20.0, 45.0}) {
    const double pen = 0.07 * height + 1;
    const Drawn capital = drawn("H", height);
    CHECK(std::abs(capital.bottom - 60) <= pen);
    CHECK(std::abs(capital.top - (60 - height)) <= pen);
    for (char c = kFirstGlyph + 1; c <= kLastGlyph; ++c) {
      CAPTURE(c);
      const Drawn glyph = drawn({&c, 1}, height);
      CHECK(glyph.top >= 60 - 1.12 * height - pen);
      CHECK(glyph.bottom <= 60 + height / 3 + pen);
      CHECK(glyph.left >= 40 - pen);
      CHECK(glyph.right <= 40 + text_width({&c, 1}, height) + pen);
    }
    const std::string text = "Hm0,";
    CHECK(std::abs(drawn(text, height).right - 40 - text_width(text, height)) <= 2 * pen);
    CHECK(text_width("00", height) > 2 * text_width("0", height));
  }
  CHECK(text_width("", 10) == 0);
  for (char c = '0'; c <= '9'; ++c) CHECK(text_width({&c, 1}, 9) == text_width("8", 9));
}

TEST_CASE("twice the size is four times the ink") {
  for (const std::string text : {"R", "g8", "(x+1)"}) {
    CHECK(drawn(text, 40).ink == doctest::Approx(4 * drawn(text, 20).ink).epsilon(0.05));
  }
}

TEST_CASE("what is beside the image is left out") {
  Image image(10, 10, kFontPaper);
  for (const double x : {-1e6, -5.0, 5.0, 1e6}) {
    for (const double y : {-1e6, 0.0, 15.0, 1e6}) draw_text(image, "Wg@", x, y, 12, kFontInk);
  }
  CHECK(image.pixels.size() == 100);
}

TEST_CASE("only printable characters of ASCII can be drawn") {
  CHECK(is_drawable(""));
  CHECK(is_drawable(" !~"));
  for (const std::string_view text : {"\n", "a\tb", "\x7f", "\xc3\xa4", "\x80"}) {
    CHECK_FALSE(is_drawable(text));
  }
}
