// SPDX-License-Identifier: MIT
// Writes a picture as SVG 1.1: its pixels as a PNG, and its strokes as lines over it, which stay
// sharp in print at any size.
#pragma once

#include <string>

#include "view/render/image.h"

namespace deliso {

// Whole or not at all; `-` is standard output. Throws InputError that names the path.
void write_svg(const Image& image, const std::string& path);

}  // namespace deliso
