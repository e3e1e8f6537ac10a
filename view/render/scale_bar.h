// SPDX-License-Identifier: MIT
// The scale of a picture: a bar of a round length, and the directions of the axes. The projection
// is parallel, so the bar's length holds at every depth. Both stand at the foot of the first panel.
#pragma once

#include <array>
#include <string_view>

#include "view/render/camera.h"
#include "view/render/image.h"
#include "view/render/layout.h"

namespace deliso {

// Returns the largest of 1, 2, 5 times a power of ten that is at most `length`. pre: length > 0.
double round_length(double length);

// At the left: the bar, and above it its length and the unit. pre: is_drawable(unit).
void draw_scale_bar(Image& image, const Layout& layout, const Camera& camera, std::string_view unit,
                    Rgb ink);

// At the right: +x, +y and +z, with their names. An axis that points away from the eye is weaker.
void draw_axes(Image& image, const Layout& layout, const Camera& camera,
               const std::array<std::string_view, 3>& names, Rgb ink);

// True if they lie in the panel whatever way they point.
bool has_room_for_axes(const Layout& layout);

}  // namespace deliso
