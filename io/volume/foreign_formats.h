// SPDX-License-Identifier: MIT
// Formats that people have volumes in and that are not read here: they are named, with a way to
// one that is.
#pragma once

#include <string>

#include "io/files/input_file.h"

namespace deliso {

// Throw InputError: for a file that is in no format of ours, and for a folder.
[[noreturn]] void refuse_file(const Bytes& bytes);
[[noreturn]] void refuse_folder(const std::string& path);

}  // namespace deliso
