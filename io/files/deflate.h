// SPDX-License-Identifier: MIT
// Compression to deflate data (RFC 1951), as it is or in a zlib wrapping (RFC 1950): the inverse of
// inflate.h.
// Hash chains find repetitions (LZ77). Each block has new Huffman codes.
//
//   D1  The same bytes give the same data on every machine.
//   D2  Codes have at most 15 bits, and no code is incomplete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/files/inflate.h"

namespace deliso {

// Compresses a stream piece by piece, each independently. Only one piece is in memory.
class DeflateStream {
 public:
  // pre: the wrapping is zlib or none.
  explicit DeflateStream(Wrapping wrapping = Wrapping::zlib)
      : wrapping_(wrapping), data_(wrapping == Wrapping::zlib ? "\x78\x9c" : "") {}

  // Returns the data that is ready, mostly none.
  std::string add(std::string_view bytes);
  std::string finish();  // returns the rest; no bytes may follow

 private:
  static constexpr std::size_t kPiece = std::size_t{1} << 22;

  void compress(bool last);

  Wrapping wrapping_;
  std::string piece_, data_;
  std::uint64_t bits_ = 0;  // of a byte that is not full
  int bit_count_ = 0;
  std::uint32_t sum_ = 1;  // Adler-32 of what was compressed
};

std::string deflate_zlib(std::string_view bytes);

}  // namespace deliso
