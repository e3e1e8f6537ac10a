// SPDX-License-Identifier: MIT
#include "io/files/lzw.h"

#include <algorithm>

namespace deliso {

std::size_t unpack_lzw(std::span<const std::byte> in, std::span<std::byte> out) {
  constexpr std::size_t kClear = 256, kEndOfData = 257, kFirst = 258, kLargest = 4096;
  // A string of the table is one before it and the byte that followed: a piece of the output.
  struct Piece {
    std::size_t at = 0, length = 0;
  };
  Piece table[kLargest];
  Piece previous;
  std::size_t next = kFirst, to = 0, from = 0;
  std::uint32_t bits = 0;
  int available = 0, width = 9;
  while (to < out.size()) {
    for (; available < width && from < in.size(); available += 8) {
      bits = bits << 8 | std::to_integer<std::uint32_t>(in[from++]);
    }
    if (available < width) return to;
    available -= width;
    const std::size_t code = bits >> available & ((1u << width) - 1);
    if (code == kEndOfData) return to;
    if (code == kClear) {
      next = kFirst;
      width = 9;
      previous = {};
      continue;
    }
    if (previous.length > 0 && next < kLargest) {
      table[next++] = {previous.at, previous.length + 1};
      // One code earlier than the table needs it.
      if (next + 1 == std::size_t{1} << width && width < 12) ++width;
    }
    if (code >= next) return to;
    if (code < kClear) {
      previous = {to, 1};
      out[to++] = static_cast<std::byte>(code);
      continue;
    }
    const Piece piece = table[code];
    previous = {to, std::min(piece.length, out.size() - to)};
    // Byte by byte: the piece may end with the first byte that is written.
    for (std::size_t n = 0; n < previous.length; ++n) out[to++] = out[piece.at + n];
  }
  return to;
}

}  // namespace deliso
