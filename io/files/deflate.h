// SPDX-License-Identifier: MIT
// Compression to deflate data (RFC 1951) in a zlib wrapping (RFC 1950): the other direction of
// inflate.h. Repetitions are found by hash chains (LZ77), the rest is left to Huffman codes,
// new ones for every block.
//
//   D1  the same bytes give the same data on every machine;
//   D2  every block has codes of its own, at most 15 bits long, and no code is incomplete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace deliso {

// Compresses bytes as they come, piece by piece, each by itself: however long the whole, no more
// than a piece is kept.
class ZlibStream {
 public:
  // Returns what of the data is ready, mostly nothing.
  std::string add(std::string_view bytes);
  std::string finish();  // the rest; nothing may be added after it

 private:
  static constexpr std::size_t kPiece = std::size_t{1} << 22;

  void compress(bool last);

  std::string piece_, data_ = "\x78\x9c";
  std::uint64_t bits_ = 0;  // of a byte that is not full
  int bit_count_ = 0;
  std::uint32_t sum_ = 1;  // Adler-32 of what was compressed
};

std::string deflate_zlib(std::string_view bytes);

}  // namespace deliso
