// SPDX-License-Identifier: MIT
// Common volume formats that are not read here. Their messages name the format and a way to convert
// it.
#pragma once

#include <string>

#include "io/files/input_file.h"

namespace deliso {

// Throw an InputError, for a file in an unknown format and for a folder.
[[noreturn]] void refuse_file(const Bytes& bytes);
void refuse_zarr(const std::string& path);  // only if it is Zarr
[[noreturn]] void refuse_folder(const std::string& path);

}  // namespace deliso
