// SPDX-License-Identifier: MIT
// Decompression of deflate data (RFC 1951), as it is or in its two usual wrappings, gzip (RFC 1952)
// and zlib (RFC 1950).
//
// 1. Nothing is written outside `out` and nothing read outside `in`, whatever the input holds.
// 2. The output is its own window: a match copies from what `out` already holds.
// 3. The wrapping's checksum (CRC-32, Adler-32) is verified whenever the end is reached.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace deliso {

enum class Wrapping { gzip, zlib, none };

struct Inflated {
  std::size_t size = 0;         // bytes written to `out`
  bool ended = false;           // the data ended here, with the right checksum if there is one
  const char* fault = nullptr;  // message about the data, or null
};

// Decompresses `in` until it ends or `out` is full. A full `out` before the end is no fault (ended
// is false), so a header can be read alone. A gzip file may have several members. Bytes after the
// last one are ignored, as gzip does.
Inflated inflate(std::span<const std::byte> in, Wrapping wrapping, std::span<std::byte> out);

// Returns the most bytes that `compressed` bytes can decompress to: two bits of deflate data give
// at most 258. No memory is allocated for a header that promises more.
constexpr std::uint64_t largest_inflated(std::uint64_t compressed) {
  return compressed > UINT64_MAX / 1032 ? UINT64_MAX : 1032 * compressed;
}

}  // namespace deliso
