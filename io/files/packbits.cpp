// SPDX-License-Identifier: MIT
#include "io/files/packbits.h"

#include <algorithm>

namespace deliso {

std::size_t unpack_bits(std::span<const std::byte> in, std::span<std::byte> out) {
  std::size_t from = 0, to = 0;
  while (from + 1 < in.size() && to < out.size()) {
    const std::size_t head = std::to_integer<std::size_t>(in[from++]);
    if (head == 128) continue;
    const bool is_run = head > 128;
    std::size_t count = std::min(is_run ? 257 - head : head + 1, out.size() - to);
    if (is_run) {
      std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(to), count, in[from]);
      ++from;
    } else {
      count = std::min(count, in.size() - from);
      std::copy_n(in.begin() + static_cast<std::ptrdiff_t>(from), count,
                  out.begin() + static_cast<std::ptrdiff_t>(to));
      from += count;
    }
    to += count;
  }
  return to;
}

}  // namespace deliso
