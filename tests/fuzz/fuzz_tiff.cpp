// SPDX-License-Identifier: MIT
#include "fuzz/reader_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  deliso::fuzz::run_reader(bytes, size, "v.tif", "v.data", deliso::read_tiff);
  return 0;
}
