// SPDX-License-Identifier: MIT
// The checksums of gzip (CRC-32, RFC 1952) and zlib (Adler-32, RFC 1950).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace deliso {

// `before`: the sum of the bytes before these.
std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before = 0);
std::uint32_t adler32(std::span<const std::byte> bytes, std::uint32_t before = 1);

}  // namespace deliso
