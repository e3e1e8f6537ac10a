// SPDX-License-Identifier: MIT
// Compression to deflate data (RFC 1951) in a zlib wrapping (RFC 1950): the other direction of
// inflate.h. Repetitions are found by hash chains (LZ77), the rest is left to Huffman codes,
// new ones for every block.
//
//   D1  the same bytes give the same data on every machine;
//   D2  every block has codes of its own, at most 15 bits long, and no code is incomplete.
#pragma once

#include <string>
#include <string_view>

namespace deliso {

std::string deflate_zlib(std::string_view bytes);

}  // namespace deliso
