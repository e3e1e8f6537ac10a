// SPDX-License-Identifier: MIT
// Captions, rules, color bars, scale bars and axes in pictures of any size. A build with sanitizers
// sees a pixel beside the picture that one of them reads or writes.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/check.h"
#include "base/random.h"
#include "mesh/meshes.h"
#include "view/render/render.h"
#include "view/render/scale_bar.h"

using namespace deliso;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Rgb kPaper{255, 255, 255}, kInk{0, 0, 0};

PictureSize random_size(Random& random) {
  const auto side = [&](double longest) {
    return static_cast<int>(std::exp(random.uniform(0, std::log(longest))));
  };
  return random.uniform(0, 1) < 0.5 ? PictureSize{side(3000), side(60)}
                                    : PictureSize{side(60), side(3000)};
}

// Draws all decorations of two panels over an empty picture. Returns whether it has room for them.
bool decorate(PictureSize size, bool strips, Random& random) {
  Camera camera;
  camera.back = direction_to({random.uniform(0, 360), random.uniform(-90, 90)});
  camera.right = direction_to({random.uniform(0, 360), random.uniform(-90, 90)});
  camera.up = cross(camera.back, camera.right);
  camera.scale = std::exp(random.uniform(-20, 20));
  Layout layout;
  try {
    layout = lay_out(size, 2, strips, strips);
  } catch (const InputError&) {
    return false;
  }
  camera.size = layout.panel;
  Image image(size.width, size.height, kPaper);
  if (strips) draw_caption(image, layout, 0, "a long caption of the first panel", kInk);
  if (strips) draw_caption(image, layout, 1, "b", kInk);
  draw_rules(image, layout, 2, kInk);
  if (strips) draw_color_bar(image, layout, {"distance", 0.3, true}, kInk);
  draw_scale_bar(image, layout, camera, "mm", kInk);
  draw_axes(image, layout, camera, {"right", "y", "head"}, kInk);
  return true;
}

}  // namespace

TEST_CASE("a rectangle of pixels is cut to the image, wherever it is") {
  Image image(7, 5, kPaper);
  const auto count = [&](double left, double top, double right, double bottom) {
    int pixels = 0;
    image.for_pixels(left, top, right, bottom, [&](int x, int y, Rgb& pixel) {
      CHECK(&pixel == &image.at(x, y));
      CHECK((0 <= x && x < 7 && 0 <= y && y < 5));
      ++pixels;
    });
    return pixels;
  };
  CHECK(count(0, 0, 7, 5) == 35);
  CHECK(count(-1e9, -1e300, 1e9, 1e300) == 35);
  CHECK(count(-kInfinity, -kInfinity, kInfinity, kInfinity) == 35);
  CHECK(count(1.9, 1, 3.1, 2) == 2);
  CHECK(count(-3, -3, -1, -1) == 0);
  CHECK(count(7, 0, 9, 5) == 0);
  CHECK(count(3, 3, 2, 2) == 0);
  CHECK(count(std::nan(""), 0, std::nan(""), 5) == 0);
}

TEST_CASE("all decorations keep to the picture, from 1 x 1 pixels on") {
  Random random(33);
  int drawn = 0;
  const auto draw = [&](PictureSize size) {
    CAPTURE(size.width);
    CAPTURE(size.height);
    for (const bool strips : {false, true}) drawn += decorate(size, strips, random);
  };
  for (const PictureSize size : {PictureSize{1, 1}, {4, 1}, {1, 4}, {5, 1}, {60, 60}, {3000, 20}}) {
    draw(size);
  }
  for (int n = 0; n < 500; ++n) draw(random_size(random));
  CHECK(drawn > 300);
}

TEST_CASE("a low picture of a mesh has its decorations") {
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const TriMesh mesh = make_tri_mesh(corners, test::tetrahedron());
  for (const PictureSize size : {PictureSize{1, 1}, {3000, 20}}) {
    RenderOptions options;
    options.size = size;
    options.view = View{40, 20};
    options.scale_bar = "mm";
    options.axes = {"x", "y", "z"};
    const Image image = render(std::array{Subject{&mesh, {}}}, options);
    CHECK(image.width == size.width);
    CHECK(image.height == size.height);
  }
}

TEST_CASE("an axis that points away has half the ink, over whatever is below it") {
  // x points to the right, away from the eye, as the only axis in the columns from 845 on.
  const Layout layout = lay_out({900, 600}, 1, false, false);
  Camera camera;
  camera.right = {0.8, -0.6, 0};
  camera.up = {0, 0, 1};
  camera.back = {-0.6, -0.8, 0};
  camera.size = layout.panel;
  const auto darkest = [&](std::uint8_t below) {
    Image image(900, 600, {below, below, below});
    draw_axes(image, layout, camera, {"", "", ""}, kInk);
    int least = 255;
    image.for_pixels(845, 0, 900, 600,
                     [&](int, int, Rgb& pixel) { least = std::min<int>(least, pixel.red); });
    return least;
  };
  CHECK(darkest(255) == 128);
  CHECK(darkest(100) == 50);
}
