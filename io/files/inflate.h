// SPDX-License-Identifier: MIT
// Decompression of deflate data (RFC 1951) in its two usual wrappings, gzip (RFC 1952) and zlib
// (RFC 1950).
//
// 1. Nothing is written outside `out` and nothing read outside `in`, whatever the input holds.
// 2. The output is its own window: a match copies from what `out` already holds.
// 3. The wrapping's checksum (CRC-32, Adler-32) is verified whenever the end is reached.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace deliso {

enum class Wrapping { gzip, zlib };

struct Inflated {
  std::size_t size = 0;         // bytes written to `out`
  bool ended = false;           // the data ended here, its checksum is right
  const char* fault = nullptr;  // what is wrong with the data, else null
};

// Decompresses `in` until it ends or `out` is full; a full `out` with more data to come is no
// fault (ended is false), so a header can be read alone. A gzip file may consist of several
// members; bytes behind the last one are ignored, as gzip does.
Inflated inflate(std::span<const std::byte> in, Wrapping wrapping, std::span<std::byte> out);

// The most bytes that `compressed` bytes can decompress to: a deflate bit pair stands for 258 bytes
// at best. What a header promises beyond this is not worth allocating memory for.
constexpr std::uint64_t largest_inflated(std::uint64_t compressed) {
  return compressed > UINT64_MAX / 1032 ? UINT64_MAX : 1032 * compressed;
}

}  // namespace deliso
