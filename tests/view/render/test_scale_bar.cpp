// SPDX-License-Identifier: MIT
// Bars against the camera's scale, and axes against its directions.
#include "view/render/scale_bar.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/random.h"

using namespace deliso;

TEST_CASE("a round length is 1, 2 or 5 times a power of ten, and the largest that fits") {
  CHECK(round_length(1) == 1);
  CHECK(round_length(0.99) == 0.5);
  CHECK(round_length(49.9) == 20);
  CHECK(round_length(5e-7) == 5e-7);
  Random random(7);
  for (int n = 0; n < 2000; ++n) {
    const double length = std::exp(random.uniform(-60, 60)), round = round_length(length);
    CAPTURE(length);
    CHECK(round <= length);
    CHECK(round > length / 2.5001);
    const double mantissa = round / std::pow(10, std::round(std::log10(round) - 0.35));
    CHECK((std::abs(mantissa - 1) < 1e-9 || std::abs(mantissa - 2) < 1e-9 ||
           std::abs(mantissa - 5) < 1e-9 || std::abs(mantissa - 10) < 1e-9));
  }
}

TEST_CASE("the bar is as long in the picture as it says") {
  const Rgb paper{255, 255, 255}, ink{0, 0, 0};
  for (const double scale : {0.003, 0.7, 4.1, 900.0}) {
    CAPTURE(scale);
    const Layout layout = lay_out({900, 600}, 1, false, false);
    Camera camera;
    camera.scale = scale;
    camera.size = layout.panel;
    Image image(900, 600, paper);
    draw_scale_bar(image, layout, camera, "mm", ink);
    // The longest run of ink in a row.
    int longest = 0;
    for (int y = 0; y < 600; ++y) {
      for (int x = 0, run = 0; x < 900; ++x) {
        run = image.at(x, y).red < 128 ? run + 1 : 0;
        longest = std::max(longest, run);
      }
    }
    const double wanted = round_length(0.25 * 900 / scale) * scale;
    CHECK(std::abs(longest - wanted) < 2 + 0.5 * layout.text);
  }
}

TEST_CASE("axes are drawn in their directions, weaker where they point away") {
  const Rgb paper{255, 255, 255}, ink{0, 0, 0};
  const Layout layout = lay_out({900, 600}, 1, false, false);
  Camera camera;
  camera.right = {0, 1, 0};
  camera.up = {0, 0, 1};
  camera.back = {1, 0, 0};
  camera.size = layout.panel;
  const auto darkest = [&](const Vec3& back, bool to_the_right) {
    camera.back = back;
    camera.right = cross(camera.up, camera.back);
    Image image(900, 600, paper);
    draw_axes(image, layout, camera, {"", "", ""}, ink);
    int left = 900, right = 0, dark = 255, top = 600;
    for (int y = 0; y < 600; ++y) {
      for (int x = 0; x < 900; ++x) {
        if (image.at(x, y).red > 250) continue;
        left = std::min(left, x);
        right = std::max(right, x);
        top = std::min(top, y);
        dark = std::min<int>(dark, image.at(x, y).red);
      }
    }
    CHECK(right - left > 2 * layout.text);
    CHECK(top < 600 - 4 * layout.text);
    CHECK(dark < 10);
    return to_the_right ? right : left;
  };
  // Seen from +x, y points to the right; seen from -x, to the left.
  CHECK(darkest({1, 0, 0}, true) > darkest({-1, 0, 0}, true));
  CHECK(darkest({1, 0, 0}, false) > darkest({-1, 0, 0}, false));
}

TEST_CASE("where axes have room, none of their ink is cut off, whatever way they point") {
  Random random(5);
  const auto ink_of = [](PictureSize size, Camera camera) {
    const Layout layout = lay_out(size, 1, false, false);
    camera.size = layout.panel;
    Image image(size.width, size.height, {255, 255, 255});
    draw_axes(image, layout, camera, {"x", "y", "z"}, {0, 0, 0});
    std::int64_t ink = 0;
    image.for_pixels(0, 0, size.width, size.height,
                     [&](int, int, const Rgb& pixel) { ink += 255 - pixel.red; });
    return ink;
  };
  int cut = 0;
  for (int n = 0; n < 200; ++n) {
    Camera camera;
    camera.back = direction_to({random.uniform(0, 360), random.uniform(-80, 80)});
    const Vec3 across = cross({0, 0, 1}, camera.back);
    camera.right = across / length(across);
    camera.up = cross(camera.back, camera.right);
    const PictureSize size{40 + static_cast<int>(random.below(80)),
                           40 + static_cast<int>(random.below(80))};
    const bool has_room = has_room_for_axes(lay_out(size, 1, false, false));
    CHECK(has_room == (std::min(size.width, size.height) >= 90));
    // A larger picture, where lines and letters are as small. Shades may be rounded otherwise.
    const std::int64_t missing = ink_of({400, 400}, camera) - ink_of(size, camera);
    if (has_room) CHECK(std::abs(missing) <= 3);
    cut += missing > 3;
  }
  CHECK(cut > 50);
}
