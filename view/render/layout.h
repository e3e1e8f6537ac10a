// SPDX-License-Identifier: MIT
// The layout of a picture. At the top is a strip of captions, one for each panel. Then come the
// panels, side by side, with thin rules between them. At the bottom is a strip for a color bar.
//
//   L1  Text, lines and rules grow with the picture, from the least size that can be read. So a
//       print looks like the screen.
#pragma once

#include <cstddef>
#include <string_view>

#include "view/render/image.h"

namespace deliso {

struct PictureSize {
  int width = 1600, height = 1200;
  friend constexpr bool operator==(const PictureSize&, const PictureSize&) = default;
};

struct Layout {
  PictureSize picture, panel;
  int captions = 0, bar = 0;  // pixels; height of the strips
  int rule = 0;               // pixels
  double text = 0;            // pixels; height of capital letters
  double line = 0;            // pixels; width of an edge where there is room for it

  int left(std::size_t panel_number) const {
    return static_cast<int>(panel_number) * (panel.width + rule);
  }
};

// What does not divide evenly is left at the right. Throws InputError where the picture is too
// small for all that. pre: panels >= 1.
Layout lay_out(PictureSize picture, std::size_t panels, bool captions, bool bar);

// Dark on a bright background, bright on a dark one.
Rgb ink_on(Rgb background);

// In the middle of the panel's caption, smaller where it would not fit. pre: is_drawable(text).
void draw_caption(Image& image, const Layout& layout, std::size_t panel_number,
                  std::string_view text, Rgb ink);
void draw_rules(Image& image, const Layout& layout, std::size_t panels, Rgb color);

}  // namespace deliso
