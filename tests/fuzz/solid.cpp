// SPDX-License-Identifier: MIT
// Solids in files of FORMAT, which CMakeLists.txt defines: bytes give an InputError of one line, or
// a solid whose corners are points, which are in range.
#include "check/check_solid.h"
#include "fuzz/reader_target.h"
#include "io/solid/read_solid.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace deliso;
  const std::vector<char> copy(bytes, bytes + size);
  try {
    // Whatever it is, it can be checked.
    check_solid(parse_solid({copy.data(), copy.size()}, SolidFormat::FORMAT, "solid").solid);
  } catch (const InputError& error) {
    fuzz::check(error);
  }
  return 0;
}
