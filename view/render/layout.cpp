// SPDX-License-Identifier: MIT
#include "view/render/layout.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/text.h"
#include "view/render/font.h"

namespace deliso {
namespace {

// In thousandths of the picture's mean side, and in pixels the least that can be read.
constexpr double kText = 13, kLeastText = 8;
constexpr double kLine = 0.9, kLeastLine = 0.9;
constexpr double kRule = 1.5, kLeastRule = 2;

// In heights of capital letters.
constexpr double kCaptionStrip = 2.6, kCaptionBaseline = 1.8;
constexpr double kBarStrip = 4.6;

}  // namespace

Layout lay_out(PictureSize picture, std::size_t panels, bool captions, bool bar) {
  const double unit = std::sqrt(static_cast<double>(picture.width) * picture.height) / 1000;
  Layout layout;
  layout.picture = picture;
  layout.text = std::max(kLeastText, kText * unit);
  layout.line = std::max(kLeastLine, kLine * unit);
  layout.rule = static_cast<int>(std::lround(std::max(kLeastRule, kRule * unit)));
  if (captions) layout.captions = static_cast<int>(std::lround(kCaptionStrip * layout.text));
  if (bar) layout.bar = static_cast<int>(std::lround(kBarStrip * layout.text));

  const auto width = static_cast<std::size_t>(picture.width);
  const std::size_t rules = (panels - 1) * static_cast<std::size_t>(layout.rule);
  if (width < rules + panels) {
    throw InputError("a picture ", width, " pixels wide has no room for ", panels, " panels");
  }
  layout.panel.width = static_cast<int>((width - rules) / panels);
  layout.panel.height = picture.height - layout.captions - layout.bar;
  if (layout.panel.height < 1) {
    throw InputError("a picture ", picture.height, " pixels high has no room for ",
                     captions ? "labels" : "a color bar");
  }
  return layout;
}

Rgb ink_on(Rgb background) {
  const double lightness =
      0.30 * background.red + 0.59 * background.green + 0.11 * background.blue;  // of 255
  return lightness > 127 ? Rgb{25, 30, 40} : Rgb{235, 238, 245};
}

void draw_caption(Image& image, const Layout& layout, std::size_t panel_number,
                  std::string_view text, Rgb ink) {
  const double room = 0.94 * layout.panel.width, wanted = text_width(text, layout.text);
  const double height = layout.text * std::min(1.0, room / std::max(room, wanted));
  draw_text(image, text,
            layout.left(panel_number) + 0.5 * (layout.panel.width - text_width(text, height)),
            kCaptionBaseline * layout.text, height, ink);
}

void draw_rules(Image& image, const Layout& layout, std::size_t panels, Rgb color) {
  for (std::size_t n = 1; n < panels; ++n) {
    const int right = layout.left(n);
    image.for_pixels(right - layout.rule, 0, right, layout.picture.height - layout.bar,
                     [&](int, int, Rgb& pixel) { pixel = color; });
  }
}

}  // namespace deliso
