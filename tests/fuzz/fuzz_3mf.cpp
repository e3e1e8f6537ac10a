// SPDX-License-Identifier: MIT
// Archives as they are, and models in a sound one.
#include "fuzz/mesh_target.h"
#include "io/mesh/containers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using deliso::MeshFormat;
  deliso::fuzz::run_parser(bytes, size, MeshFormat::three_mf);
  const std::string file = deliso::test::three_mf_file({bytes, bytes + size});
  deliso::fuzz::run_parser(reinterpret_cast<const std::uint8_t*>(file.data()), file.size(),
                           MeshFormat::three_mf);
  return 0;
}
