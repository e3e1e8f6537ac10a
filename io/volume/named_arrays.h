// SPDX-License-Identifier: MIT
// Which of a file's named arrays to read, for the formats that have names (VTK's).
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "io/volume/volume_formats.h"

namespace deliso {

// The index of the array that the options name; else that of `active`, the name that the file has
// for the one to look at; else of the first that can be meshed. All go to the log, and a note where
// one was taken out of several. Throws InputError when there is none, or it is not scalar. Of equal
// names the first counts.
std::size_t choose_array(const VolumeInput& input, std::vector<NamedArray> arrays,
                         std::string_view active);

}  // namespace deliso
