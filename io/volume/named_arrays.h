// SPDX-License-Identifier: MIT
// The choice between a file's named arrays (VTK).
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "io/volume/volume_formats.h"

namespace deliso {

// Returns the index of the array to read: the one that the options name, else `active`, the one
// that the file names, if it can be meshed, else the first that can. Of equal names the first
// counts. Logs all arrays, and a note if it chose one of several. Throws InputError if there is
// none or it is not scalar.
std::size_t choose_array(const VolumeInput& input, std::vector<NamedArray> arrays,
                         std::string_view active);

}  // namespace deliso
