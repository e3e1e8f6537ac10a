// SPDX-License-Identifier: MIT
// TIFF's LZW (TIFF 6.0, section 13): codes of 9 to 12 bits, the highest bit first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace deliso {

// Decompresses `in` until its end code, a code that is none, or until `out` is full. Returns the
// number of bytes written.
std::size_t unpack_lzw(std::span<const std::byte> in, std::span<std::byte> out);

// Returns the most bytes that `packed` bytes can unpack to: a code of 9 bits or more gives at most
// 3839, the longest string of a full table.
constexpr std::uint64_t largest_of_lzw(std::uint64_t packed) {
  return packed > UINT64_MAX / 3413 ? UINT64_MAX : 3413 * packed;
}

}  // namespace deliso
