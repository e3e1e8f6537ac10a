// SPDX-License-Identifier: MIT
// Files of the reader READER under the name NAME, with DATA beside them (CMakeLists.txt).
#include "fuzz/reader_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  deliso::fuzz::run_reader(bytes, size, NAME, DATA, deliso::READER);
  return 0;
}
