// SPDX-License-Identifier: MIT
// PackBits, the run lengths of TIFF (6.0, section 9) and of DICOM's RLE (PS3.5, annex G).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace deliso {

// Decompresses `in` until it ends or `out` is full. Returns the number of bytes written.
std::size_t unpack_bits(std::span<const std::byte> in, std::span<std::byte> out);

// Returns the most bytes that `packed` bytes can unpack to: two give at most 128.
constexpr std::uint64_t largest_unpacked(std::uint64_t packed) {
  return packed > UINT64_MAX / 64 ? UINT64_MAX : 64 * packed;
}

}  // namespace deliso
