// SPDX-License-Identifier: MIT
// Getting results out: standard output with its errors seen, files whole or not at all.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace deliso {

// Writes to standard output and flushes. Throws InputError when it cannot all be written.
void print(std::string_view text);

// Writes a file, whole or not at all; `-` is standard output. Throws InputError.
void write_text(const std::string& path, std::string_view text);

// What must hold before the work begins; throws InputError where it does not. The names of files in
// a run: `outputs`, in the order in which they are named, and all that is read. Empty names are
// none, `-` is the standard stream.
//   - no output has the same file, through links too, as another name: it would replace that. (What
//     is no regular file, such as /dev/null, takes any number.)
//   - every output could be written: its folder is there and may be written to, it is no folder
//     itself, and nobody has made it read-only.
void require_outputs(std::span<const std::string> outputs, std::span<const std::string> inputs);

}  // namespace deliso
