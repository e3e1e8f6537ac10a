// SPDX-License-Identifier: MIT
#include "view/render/scale_bar.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/text.h"
#include "base/vec2.h"
#include "view/render/font.h"

namespace deliso {
namespace {

// In heights of capital letters.
constexpr double kMargin = 1.5, kScaleThick = 0.22, kScaleGap = 0.5, kScaleTick = 0.8, kAxis = 3.2,
                 kName = 0.9;
constexpr double kLongest = 0.25;  // of the panel's width

// A line with round ends, over the image. `strength`: share of the ink, 1 hides what is below.
void draw_line(Image& image, const Vec2& a, const Vec2& b, double width, Rgb color,
               double strength = 1) {
  const double margin = width + 1;
  const Vec2 d = b - a;
  const double size2 = dot(d, d);
  const auto draw = [&](int x, int y, Rgb& pixel) {
    const Vec2 p{x + 0.5, y + 0.5};
    const double t = size2 > 0 ? std::clamp(dot(p - a, d) / size2, 0.0, 1.0) : 0;
    const Vec2 off = p - (a + t * d);
    const double share = std::clamp(0.5 + 0.5 * width - std::sqrt(dot(off, off)), 0.0, 1.0);
    pixel = mixed(pixel, color, strength * share);
  };
  image.for_pixels(std::min(a.x, b.x) - margin, std::min(a.y, b.y) - margin,
                   std::max(a.x, b.x) + margin + 1, std::max(a.y, b.y) + margin + 1, draw);
}

double foot_of(const Layout& layout) {
  return layout.captions + layout.panel.height - kMargin * layout.text;
}

Vec2 origin_of_axes(const Layout& layout) {
  const double h = layout.text, size = kAxis * h;
  return {layout.panel.width - size - 2 * kMargin * h, foot_of(layout) - size - kMargin * h};
}

}  // namespace

double round_length(double length) {
  const int exponent = static_cast<int>(std::floor(std::log10(length)));
  const double scale = std::pow(10.0, std::abs(exponent));
  double best = 0;
  for (const int mantissa : {1, 2, 5, 10}) {
    const double candidate = exponent < 0 ? mantissa / scale : mantissa * scale;
    if (candidate <= length || best == 0) best = candidate;
  }
  return best;
}

void draw_scale_bar(Image& image, const Layout& layout, const Camera& camera, std::string_view unit,
                    Rgb ink) {
  const double length = round_length(kLongest * layout.panel.width / camera.scale);
  const double h = layout.text, left = kMargin * h, right = left + length * camera.scale;
  const double y = foot_of(layout), tick = 0.5 * kScaleTick * h;
  draw_line(image, {left, y}, {right, y}, kScaleThick * h, ink);
  for (const double x : {left, right}) {
    draw_line(image, {x, y - tick}, {x, y + tick}, kScaleThick * h, ink);
  }
  const std::string label = text(length, unit.empty() ? "" : " ", unit);
  draw_text(image, label, 0.5 * (left + right - text_width(label, h)), y - tick - kScaleGap * h, h,
            ink);
}

void draw_axes(Image& image, const Layout& layout, const Camera& camera,
               const std::array<std::string_view, 3>& names, Rgb ink) {
  const double h = layout.text, size = kAxis * h;
  const Vec2 origin = origin_of_axes(layout);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int i = static_cast<int>(axis);
    const Vec2 direction{camera.right[i], -camera.up[i]};
    const double strength = camera.back[i] < 0 ? 0.5 : 1;
    draw_line(image, origin, origin + size * direction, kScaleThick * h, ink, strength);
    const Vec2 at = origin + (size + kName * h) * direction;
    draw_text(image, names[axis], at.x - 0.5 * text_width(names[axis], h), at.y + 0.5 * h, h, ink,
              strength);
  }
}

bool has_room_for_axes(const Layout& layout) {
  const Vec2 origin = origin_of_axes(layout);
  return std::min(origin.x, origin.y - layout.captions) >= (kAxis + 2 * kName) * layout.text;
}

}  // namespace deliso
