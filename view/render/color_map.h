// SPDX-License-Identifier: MIT
// Colors that stand for numbers.
//
//   M1  Along the sequential map lightness grows evenly, so it can be read in gray and by the
//       color-blind. It runs over violet, blue, green and light yellow. No color is so dark that it
//       hides light and shade.
//   M2  The colors of kinds differ in hue and are alike in lightness.
#pragma once

#include <cstddef>

#include "view/render/image.h"

namespace deliso {

// Returns the color of a share from 0 to 1. Shares beyond are clamped, and NaN counts as 1.
Rgb sequential_color(double share);

// The first kCategories differ for all readers; those of hundreds from there on are darker or
// lighter ones of them.
inline constexpr std::size_t kCategories = 7;
Rgb category_color(std::size_t number);

}  // namespace deliso
