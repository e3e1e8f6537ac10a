// SPDX-License-Identifier: MIT
// A built-in field (builtin_fields.h) as an input that is named, like a file.
#pragma once

#include <string_view>

#include "io/volume/builtin_fields.h"
#include "io/volume/read_volume.h"
#include "volume/volume.h"

namespace deliso {

// The field that "builtin:NAME[:SIZE]" names; null if `input` does not begin with "builtin:".
// Throws InputError for an unknown name.
const BuiltinField* find_builtin_field(std::string_view input);

// The volume of "builtin:NAME[:SIZE]", SIZE from 16 to 1024. Throws InputError.
// Of the options it takes the region and the block.
Volume make_builtin_volume(std::string_view input, const ReadOptions& options = {});

}  // namespace deliso
