// SPDX-License-Identifier: MIT
// Meshes to write, and the bytes of their files.
#pragma once

#include <doctest/doctest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <type_traits>

#include "io/files/temporary_folder.h"
#include "io/mesh/write_mesh.h"
#include "mesh/meshes.h"

namespace deliso::test {

inline std::string written(const TriMesh& mesh, MeshWriteOptions options) {
  const TemporaryFolder folder;
  write_mesh(mesh, folder / "mesh", options);
  return file_bytes(folder / "mesh");
}

inline TriMesh random_sphere(std::uint64_t seed) {
  RandomMesh source(octahedron(), seed);
  for (int i = 0; i < 40; ++i) source.change();
  TriMesh mesh = source.mesh();
  for (Vec3& p : mesh.points) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = source.random().uniform(-100, 100);
  }
  return mesh;
}

// Little endian, from the bytes themselves.
template <class T>
T number_at(const std::string& bytes, std::size_t at) {
  REQUIRE(at + sizeof(T) <= bytes.size());
  std::uint64_t bits = 0;
  for (std::size_t i = sizeof(T); i-- > 0;) {
    bits = bits << 8 | static_cast<unsigned char>(bytes[at + i]);
  }
  if constexpr (std::is_same_v<T, float>)
    return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
  else if constexpr (std::is_same_v<T, double>)
    return std::bit_cast<double>(bits);
  else
    return static_cast<T>(bits);
}

// Values that differ everywhere, for a mesh whose facets from the third on are caps.
inline MeshWriteOptions with_attributes(const TriMesh& mesh, MeshFormat format) {
  MeshAttributes values;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const auto x = static_cast<float>(v);
    values.normals.push_back({x, 0.5f - x, 0.1f * x});
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    values.component.push_back(static_cast<std::uint32_t>(f / 2));
    values.distance.push_back(0.1f * static_cast<float>(f));
  }
  return {.format = format, .first_cap = 3, .attributes = values};
}

}  // namespace deliso::test
