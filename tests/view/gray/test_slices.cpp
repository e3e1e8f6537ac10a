// SPDX-License-Identifier: MIT
// Slices, pixel by pixel, against the interpolant at the pixel's place in the world.
#include "view/gray/slices.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "base/check.h"
#include "base/random.h"

using namespace deliso;

namespace {

// Darker than paper at the border of a letter, which may be gray too.
bool is_gray(const Rgb& p) {
  return p.red == p.green && p.green == p.blue && p.red < 240;
}
// More red than any mixture of ink and paper.
bool is_curve(const Rgb& p) {
  return p.red > p.blue + 8;
}

struct Rectangle {
  int left = 1 << 20, top = 1 << 20, right = -1, bottom = -1;
  int width() const { return right - left; }
  int height() const { return bottom - top; }
};

// Finds the slice in a panel. pre: its grays are below 240.
Rectangle slice_in(const Image& image, const Layout& layout, int panel) {
  const int width = (image.width - 2 * layout.rule) / 3, left = panel * (width + layout.rule);
  Rectangle found;
  for (int y = layout.captions; y < image.height; ++y) {
    for (int x = left; x < left + width; ++x) {
      const Rgb& p = image.at(x, y);
      if (!is_curve(p) && !is_gray(p)) continue;
      found = {std::min(found.left, x), std::min(found.top, y), std::max(found.right, x + 1),
               std::max(found.bottom, y + 1)};
    }
  }
  return found;
}

// What is to the right and up in the picture, in the world, for the three slices.
struct Directions {
  std::array<Vec3, 3> right, up;
};
constexpr Directions kPlain{{Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{1, 0, 0}},
                            {Vec3{0, 0, 1}, Vec3{0, 0, 1}, Vec3{0, 1, 0}}};
constexpr Directions kLps{{Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{1, 0, 0}},
                          {Vec3{0, 0, 1}, Vec3{0, 0, 1}, Vec3{0, -1, 0}}};
constexpr Directions kRas{{Vec3{0, -1, 0}, Vec3{-1, 0, 0}, Vec3{-1, 0, 0}},
                          {Vec3{0, 0, 1}, Vec3{0, 0, 1}, Vec3{0, 1, 0}}};

double along(const Vec3& direction, const Vec3& sides) {
  return std::abs(dot(direction, sides));
}

void check_slices(const Frame& frame, const Directions& directions, Random& random) {
  std::vector<double> samples;
  for (int n = 0; n < 6 * 5 * 4; ++n) samples.push_back(random.uniform());
  const Volume volume = Volume::from_samples({6, 5, 4}, {1, 0.5, 2}, samples, frame);
  SliceOptions options;
  options.size = {900, 500};
  options.through = {2.3, 1.1, 3.7};
  options.kappa = 0.5;
  options.window = {-0.5, 1.5};
  options.threads = 2;
  const Image image = draw_slices(volume, options);
  const Layout layout = lay_out(options.size, 3, true, false);
  const double pen = 2 * layout.line;  // pixels

  const Vec3 lo = frame.to_world(volume.box().lo), hi = frame.to_world(volume.box().hi);
  const Vec3 middle = 0.5 * (lo + hi), sides = hi - lo, through = frame.to_world(options.through);
  for (int n = 0; n < 3; ++n) {
    CAPTURE(n);
    const Vec3 right = directions.right[static_cast<std::size_t>(n)],
               up = directions.up[static_cast<std::size_t>(n)], normal = cross(right, up);
    const Rectangle slice = slice_in(image, layout, n);
    const double scale = slice.width() / along(right, sides);
    CHECK(std::abs(slice.height() - scale * along(up, sides)) < 1 + scale / slice.width());
    const auto value = [&](double x, double y) {
      const Vec3 in_plane = (x - 0.5 * (slice.left + slice.right)) / scale * right +
                            (0.5 * (slice.top + slice.bottom) - y) / scale * up + middle;
      const Vec3 p = in_plane + dot(through - in_plane, normal) * normal;
      return volume.value(frame.from_world(p));
    };
    int curves = 0, grays = 0;
    for (int y = slice.top; y < slice.bottom; ++y) {
      for (int x = slice.left; x < slice.right; ++x) {
        const double here = value(x + 0.5, y + 0.5);
        // A pixel that the curve crosses is drawn; a drawn one has the curve within the pen.
        bool crossed = false, near = false;
        const double reach = 0.5 * pen + 1;
        for (int k = 0; k < 32; ++k) {
          const double turn = 0.19634954 * k;
          const auto other_side = [&](double radius) {
            return (here >= 0.5) != (value(x + 0.5 + radius * std::cos(turn),
                                           y + 0.5 + radius * std::sin(turn)) >= 0.5);
          };
          crossed |= other_side(0.5);
          near |= other_side(0.5 * reach) || other_side(reach);
        }
        const Rgb& pixel = image.at(x, y);
        if (crossed) CHECK(is_curve(pixel));
        if (is_curve(pixel)) CHECK(near);
        curves += is_curve(pixel);
        if (!is_gray(pixel)) continue;
        ++grays;
        CHECK(std::abs(pixel.red - 255 * options.window.gray(here)) < 4);
      }
    }
    CHECK(std::min(curves, grays) > 200);
  }
}

}  // namespace

TEST_CASE("a slice has the gray of its place, and its curve where the field changes its side") {
  Random random(11);
  check_slices({}, kPlain, random);
  Frame lps{{5, 6, 7}};
  lps.space = AnatomicalSpace::lps;
  check_slices(lps, kLps, random);
  // A sagittal scan: rows lead to the back, columns down, slices to the right.
  Frame ras{{-8, 0, 1}, {Vec3{0, -1, 0}, Vec3{0, 0, -1}, Vec3{1, 0, 0}}, AnatomicalSpace::ras};
  check_slices(ras, kRas, random);
}

TEST_CASE("slices fill the picture's width or height, and their place is clamped to the volume") {
  const Volume high = Volume::from_samples({2, 3, 40}, {1, 1, 1}, std::vector<float>(240, 1.0F));
  SliceOptions options{.size = {800, 600}, .through = {-5, 99, 1e300}};
  const Image narrow = draw_slices(high, options);
  CHECK(narrow.width < 800);
  CHECK(std::abs(narrow.height - 600) <= 1);
  const Volume wide = Volume::from_samples({40, 40, 2}, {1, 1, 1}, std::vector<float>(3200, 1.0F));
  const Image low = draw_slices(wide, options);
  CHECK(std::abs(low.width - 800) <= 3);
  CHECK(low.height < 400);
  options.size = {800, 40};
  CHECK_THROWS_AS(draw_slices(wide, options), InputError);
  const Volume flat = Volume::from_samples({40, 40, 1}, {1, 1, 1}, std::vector<float>(1600, 1.0F));
  CHECK_THROWS_AS(draw_slices(flat, {}), InputError);
}
