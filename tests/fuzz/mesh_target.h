// SPDX-License-Identifier: MIT
// What the targets of the mesh readers share: bytes give an InputError of one line, or a mesh whose
// corners are vertices and whose points are in range.
#pragma once

#include "fuzz/reader_target.h"
#include "io/mesh/read_mesh.h"
#include "mesh/tri_mesh.h"

namespace deliso::fuzz {

inline void check_read_mesh(const TriMesh& mesh) {
  for (const Vec3& p : mesh.points) {
    require(in_range(p), "a point out of range");
  }
  for (const Face& face : mesh.faces) {
    for (const VertexId v : face.v) require(v < mesh.points.size(), "a corner that is no vertex");
  }
}

inline void run_parser(const std::uint8_t* bytes, std::size_t size, MeshFormat format) {
  const std::vector<char> copy(bytes, bytes + size);
  try {
    check_read_mesh(parse_mesh({copy.data(), copy.size()}, format, "mesh"));
  } catch (const InputError& error) {
    check_message(error);
  }
}

}  // namespace deliso::fuzz
