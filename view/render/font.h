// SPDX-License-Identifier: MIT
// A small font of strokes, for the captions and scales of pictures. It has the printable characters
// of ASCII. A pen with a round tip draws them at any size, with smooth edges.
#pragma once

#include <string_view>

#include "view/render/image.h"

namespace deliso {

inline constexpr char kFirstGlyph = ' ', kLastGlyph = '~';

// Whether every character has a glyph.
bool is_drawable(std::string_view text);

// Returns the width in pixels, from the left edge of the first glyph to the right edge of the last.
// `height` is that of capital letters. A third of it is needed below the baseline. pre:
// is_drawable(text).
double text_width(std::string_view text, double height);

// Draws the text over the image, on the line y = baseline, from x = left on. Parts beside the image
// are left out. `strength`: share of the color; 1 hides the image below. pre: is_drawable(text).
void draw_text(Image& image, std::string_view text, double left, double baseline, double height,
               Rgb color, double strength = 1);

}  // namespace deliso
