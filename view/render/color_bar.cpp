// SPDX-License-Identifier: MIT
#include "view/render/color_bar.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "view/render/color_map.h"
#include "view/render/font.h"

namespace deliso {
namespace {

constexpr int kMostSteps = 6;

// In heights of capital letters, from the top of the strip.
constexpr double kTop = 0.6, kThick = 1.2, kTick = 0.35, kGap = 0.4;
constexpr double kLong = 26, kBeside = 1.5;

// A distance between ticks, as mantissa * 10^exponent: its multiples then have few digits.
struct Step {
  int mantissa;
  int exponent;
  double times(double n) const {
    const double scale = std::pow(10.0, std::abs(exponent));
    return exponent < 0 ? n * mantissa / scale : n * mantissa * scale;
  }
};

Step step_for(double hi) {
  for (int exponent = static_cast<int>(std::floor(std::log10(hi))) - 2;; ++exponent) {
    for (const int mantissa : {1, 2, 5}) {
      const Step step{mantissa, exponent};
      if (hi <= step.times(kMostSteps + 0.001)) return step;
    }
  }
}

}  // namespace

std::vector<double> ticks_up_to(double hi) {
  const Step step = step_for(hi);
  std::vector<double> ticks;
  for (int n = 0; step.times(n) <= hi * 1.0001; ++n) ticks.push_back(step.times(n));
  return ticks;
}

double round_up(double value) {
  const Step step = step_for(value);
  return step.times(std::max(1.0, std::ceil(value / step.times(1) - 0.001)));
}

void draw_color_bar(Image& image, const Layout& layout, const ColorBar& bar, Rgb ink) {
  // The title stands left of the bar; the last number reaches out to the right.
  const auto whole_width = [&](double height) {
    return text_width(bar.title, height) + (kBeside + kLong + 2) * height;
  };
  const double room = 0.96 * layout.picture.width;
  const double height = layout.text * std::min(1.0, room / whole_width(layout.text));
  const double left = 0.5 * (layout.picture.width - whole_width(height));
  const double top = layout.picture.height - layout.bar + kTop * height;
  draw_text(image, bar.title, left, top + (0.5 * kThick + 0.5) * height, height, ink);

  const double begin = left + text_width(bar.title, height) + kBeside * height;
  const double length = kLong * height;
  // At least a pixel wide.
  const auto fill = [&](double x0, double x1, double y0, double y1, auto color_at) {
    const double from = std::round(x0), to = std::max(from + 1, std::round(x1));
    image.for_pixels(from, std::round(y0), to, std::round(y1),
                     [&](int x, int, Rgb& pixel) { pixel = color_at(x); });
  };
  fill(begin, begin + length, top, top + kThick * height,
       [&](int x) { return sequential_color((x + 0.5 - begin) / length); });

  const std::vector<double> ticks = ticks_up_to(bar.hi);
  const double below = top + kThick * height, half = 0.5 * layout.line;
  for (const double value : ticks) {
    const double x = begin + value / bar.hi * length;
    fill(x - half, x + half, below, below + kTick * height, [&](int) { return ink; });
    const std::string number = text(value, bar.open && value == ticks.back() ? "+" : "");
    draw_text(image, number, x - 0.5 * text_width(number, height),
              below + (kTick + kGap + 1) * height, height, ink);
  }
}

}  // namespace deliso
