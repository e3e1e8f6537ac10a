// SPDX-License-Identifier: MIT
// A picture: rows from the top, pixels from the left, three bytes each (sRGB red, green, blue).
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

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

struct Image {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;  // width * height

  Image() = default;
  Image(int columns, int rows, Rgb color = {})
      : width(columns),
        height(rows),
        pixels(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), color) {}

  const Rgb& at(int x, int y) const { return pixels[index(x, y)]; }
  Rgb& at(int x, int y) { return pixels[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

}  // namespace deliso
