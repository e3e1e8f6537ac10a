// SPDX-License-Identifier: MIT
// Two bytes with the picture's columns and rows, less one, then a stream of JPEG or JPEG-LS.
#include <span>
#include <vector>

#include "fuzz/reader_target.h"
#include "io/files/jpeg.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace deliso;
  using namespace deliso::fuzz;
  if (size < 2) return 0;
  const std::size_t columns = 1 + std::size_t{bytes[0]}, rows = 1 + std::size_t{bytes[1]};
  const std::vector<std::uint8_t> in(bytes + 2, bytes + size);
  std::vector<std::uint16_t> out(columns * rows);
  const JpegPicture picture = decode_jpeg(std::as_bytes(std::span(in)), columns, rows, out);
  if (picture.fault) return 0;
  require(picture.bits >= 2 && picture.bits <= 16, "a picture without its number of bits");
  require(largest_jpeg(in.size()) >= out.size(), "more samples than there can be");
  return 0;
}
