// SPDX-License-Identifier: MIT
// Files of FORMAT, which CMakeLists.txt defines.
#include "fuzz/mesh_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  deliso::fuzz::run_parser(bytes, size, deliso::MeshFormat::FORMAT);
  return 0;
}
