// SPDX-License-Identifier: MIT
// The scale below a picture that says which number a color of the sequential map stands for.
#pragma once

#include <string>
#include <vector>

#include "view/render/image.h"
#include "view/render/layout.h"

namespace deliso {

struct ColorBar {
  std::string title;  // what the numbers are, and their unit
  double hi = 1;      // the map's upper end; the lower one is 0
  bool open = false;  // there are greater numbers, which have the color of hi
};

// Returns the values to label: multiples of 1, 2 or 5 times a power of ten, from 0 to `hi`. There
// are four to seven of them if `hi` is such a multiple too. pre: hi > 0, finite.
std::vector<double> ticks_up_to(double hi);

// The least number from `value` on that ends such a scale. pre: value > 0, finite.
double round_up(double value);

// Into the layout's strip for it. pre: is_drawable(bar.title).
void draw_color_bar(Image& image, const Layout& layout, const ColorBar& bar, Rgb ink);

}  // namespace deliso
