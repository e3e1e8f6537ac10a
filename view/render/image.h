// SPDX-License-Identifier: MIT
// A picture: rows from the top, pixels from the left, three bytes each (sRGB red, green, blue).
//
//   M1  Captions, bars, axes and other decorations may lie beside a small picture. They reach its
//       pixels by for_pixels() alone, which cuts them to it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec2.h"

namespace deliso {

struct Rgb {
  std::uint8_t red = 0, green = 0, blue = 0;
  friend constexpr bool operator==(const Rgb&, const Rgb&) = default;
};

inline Rgb mixed(Rgb a, Rgb b, double share_of_b) {
  const auto mix = [share_of_b](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround((1 - share_of_b) * from + share_of_b * to));
  };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

// A line with round ends; lengths in pixels.
struct Stroke {
  Vec2 from, to;
  double width = 1;
  Rgb color;
  double strength = 1;  // share of the color
};

struct Image {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;  // width * height
  // For a picture whose edges and letters stay lines, they are here, and over the pixels.
  bool keeps_strokes = false;
  std::vector<Stroke> strokes;

  Image() = default;
  Image(int columns, int rows, Rgb color = {})
      : width(columns),
        height(rows),
        pixels(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), color) {}

  // pre: 0 <= x < width, 0 <= y < height.
  const Rgb& at(int x, int y) const { return pixels[index(x, y)]; }
  Rgb& at(int x, int y) { return pixels[index(x, y)]; }

  // Calls f(x, y, pixel) for the pixels of the image in the rectangle, whose sides are rounded down
  // to whole pixels. It may be anywhere, and of any size.
  template <class F>
  void for_pixels(double left, double top, double right, double bottom, F f) {
    const int x_begin = clipped(left, width), x_end = clipped(right, width);
    const int y_begin = clipped(top, height), y_end = clipped(bottom, height);
    for (int y = y_begin; y < y_end; ++y) {
      for (int x = x_begin; x < x_end; ++x) f(x, y, at(x, y));
    }
  }

 private:
  static int clipped(double place, int size) {
    // Written so that a NaN is 0.
    return place > 0 ? static_cast<int>(std::min(std::floor(place), static_cast<double>(size))) : 0;
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

}  // namespace deliso
