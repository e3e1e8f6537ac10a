// SPDX-License-Identifier: MIT
// Built-in fields (builtin_fields.h) as inputs with names, like files.
#pragma once

#include <string_view>

#include "io/volume/builtin_fields.h"
#include "io/volume/read_volume.h"
#include "volume/volume.h"

namespace deliso {

// Returns the field of "builtin:NAME[:SIZE]"; null if `input` does not begin with "builtin:".
// Throws InputError for an unknown name.
const BuiltinField* find_builtin_field(std::string_view input);

// Returns the volume of "builtin:NAME[:SIZE]", SIZE from 16 to 1024. Uses only the two
// regions of the options. Throws InputError.
Volume make_builtin_volume(std::string_view input, const ReadOptions& options = {});

}  // namespace deliso
