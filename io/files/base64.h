// SPDX-License-Identifier: MIT
// Base64 (RFC 4648). As in VTK's XML files, several pieces may follow each other, each with its own
// padding.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace deliso {

// Decodes groups of four characters; skips white space. Stops after `at_most` bytes, at the end of
// the text, or at a character that is not base64; the caller sees it from the size. Padding ends a
// piece, not the decoding.
std::vector<std::byte> decode_base64(std::string_view text, std::size_t at_most);

// Returns the code in one line, padded. Codes of multiples of three bytes can be concatenated.
std::string encode_base64(std::span<const std::byte> bytes);

}  // namespace deliso
