// SPDX-License-Identifier: MIT
// Decompression of the pictures of DICOM that lose nothing: JPEG's process 14 (ITU-T T.81, annex
// H), with each of its predictors, and JPEG-LS (ITU-T T.87), near-lossless too. One component of 2
// to 16 bits.
//
// 1. Nothing is written outside `out` and nothing read outside `in`, whatever the input holds.
// 2. A missing or impossible code is a fault. There is no checksum, so damage may pass unseen as
//    another picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace deliso {

struct JpegPicture {
  int bits = 0;                 // of a sample; the others of the 16 are 0
  const char* fault = nullptr;  // message about the data, or null
};

// Fills `out` with the picture, row by row. pre: out.size() == columns * rows > 0.
JpegPicture decode_jpeg(std::span<const std::byte> in, std::size_t columns, std::size_t rows,
                        std::span<std::uint16_t> out);

// Returns the most samples that `compressed` bytes can decompress to: one bit of JPEG-LS stands for
// a run of 2^15 at most.
constexpr std::uint64_t largest_jpeg(std::uint64_t compressed) {
  return compressed > UINT64_MAX >> 18 ? UINT64_MAX : compressed << 18;
}

}  // namespace deliso
