// SPDX-License-Identifier: MIT
// Comments and names that files of all formats may have.
#pragma once

#include <string>
#include <string_view>

namespace deliso {

// Returns a comment that every format allows: printable ASCII without `\` and `--`, `?` for others.
std::string plain_comment(std::string comment);
// Returns UTF-8 without control characters, `?` for all else.
std::string plain_name(std::string_view name);

}  // namespace deliso
