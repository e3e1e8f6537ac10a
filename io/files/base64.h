// SPDX-License-Identifier: MIT
// Base64 (RFC 4648). As VTK's XML files hold it, several pieces, each with its own padding, may
// stand one behind the other.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace deliso {

// Decodes groups of four characters, skipping white space, until `at_most` bytes are decoded or the
// text ends or holds a character that is not base64; the caller sees from the size which. Padding
// ends a piece, not the decoding.
std::vector<std::byte> decode_base64(std::string_view text, std::size_t at_most);

// In one line, padded. What is encoded in multiples of three bytes may be put together.
std::string encode_base64(std::span<const std::byte> bytes);

}  // namespace deliso
