// SPDX-License-Identifier: MIT
// What the targets of the mesh readers share: bytes give an InputError of one line, or a mesh whose
// corners are vertices and whose points are in range.
#pragma once

#include "fuzz/reader_target.h"
#include "io/mesh/read_mesh.h"

namespace deliso::fuzz {

inline void run_parser(const std::uint8_t* bytes, std::size_t size, MeshFormat format) {
  const std::vector<char> copy(bytes, bytes + size);
  try {
    check(parse_mesh({copy.data(), copy.size()}, format, "mesh"));
  } catch (const InputError& error) {
    check(error);
  }
}

}  // namespace deliso::fuzz
