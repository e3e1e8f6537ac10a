// SPDX-License-Identifier: MIT
// Decompression alone. The first byte picks the wrapping, the second the size of the output.
// The same data into a smaller output must give the same bytes.
#include <algorithm>

#include "fuzz/reader_target.h"
#include "io/files/inflate.h"

using namespace deliso;
using namespace deliso::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size < 2) return 0;
  const auto wrapping = static_cast<Wrapping>(bytes[0] % 3);
  const std::size_t room = std::size_t{1} << (bytes[1] % 20);
  const std::vector<std::uint8_t> copy(bytes + 2, bytes + size);
  const auto in = std::as_bytes(std::span(copy));
  std::vector<std::byte> out(room), part(room / 2 + room % 2);
  const Inflated whole = inflate(in, wrapping, out);
  require(whole.size <= out.size(), "more bytes than there is room for");
  require(whole.size <= largest_inflated(size), "more bytes than deflate can hold");
  require(!(whole.ended && whole.fault), "ended, and at fault");
  const Inflated half = inflate(in, wrapping, part);
  require(half.size == std::min(whole.size, part.size()), "another size in a smaller output");
  require(
      std::equal(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(half.size), out.begin()),
      "other bytes in a smaller output");
  return 0;
}
