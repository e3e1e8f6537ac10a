// SPDX-License-Identifier: MIT
// Colors that stand for numbers.
//
//   M1  along the sequential map lightness grows, evenly to the eye, so that it can be read in gray
//       and by the color-blind: violet, blue, green, light yellow, none so dark that it
//       hides light and shade;
//   M2  the colors of kinds differ in hue and are alike in lightness.
#pragma once

#include <cstddef>

#include "view/render/image.h"

namespace deliso {

// From 0 to 1; what is beyond, or no number, is taken as the nearer end, or as 1.
Rgb sequential_color(double share);

// The first kCategories differ; from there on they come again.
inline constexpr std::size_t kCategories = 10;
Rgb category_color(std::size_t number);

}  // namespace deliso
