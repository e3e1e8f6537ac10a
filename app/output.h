// SPDX-License-Identifier: MIT
// Output: standard output with a test for errors, and files that appear whole or not at all.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/diagnostics.h"

namespace deliso {

// Writes to standard output and flushes. Throws InputError unless all of it is written.
void print(std::string_view text);
// Writes a report there or, if another output takes standard output, to standard error.
void print_report(std::string_view text, bool stdout_taken);
// Writes the warnings of a list to standard error, a line each.
void print_warnings(const Diagnostics& notes);

// Writes a file, whole or not at all; `-` is standard output. Throws InputError.
void write_text(const std::string& path, std::string_view text);

// Checks the names of files before a run: `outputs`, in their order, and all inputs. Empty names
// are ignored; `-` is the standard stream. Throws InputError unless:
//   - No output is the same file as another name, through links too, since it would replace that
//     file. Only regular files are tested; /dev/null can have any number of outputs.
//   - Every output can be written. Its folder exists and is writable. The output is no folder and
//     not read-only.
void require_outputs(std::span<const std::string> outputs, std::span<const std::string> inputs);

}  // namespace deliso
