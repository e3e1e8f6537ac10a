// SPDX-License-Identifier: MIT
// Writes a picture as PNG (ISO/IEC 15948): 8 bit RGB, not interlaced. Each row has the filter with
// the smallest sum (the standard's rule of thumb, 12.8). The same picture gives the same bytes.
#pragma once

#include <string>

#include "view/render/image.h"

namespace deliso {

// The whole file. pre: width and height are at least 1.
std::string encode_png(const Image& image);

// Whole or not at all; `-` is standard output. Throws InputError that names the path.
void write_png(const Image& image, const std::string& path);

}  // namespace deliso
