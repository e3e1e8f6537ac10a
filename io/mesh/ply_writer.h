// SPDX-License-Identifier: MIT
// A PLY file vertex by vertex, then facet by facet, for meshes that are never in memory as a whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/triangle.h"
#include "base/vec3.h"
#include "io/files/atomic_file.h"
#include "io/mesh/write_mesh.h"

namespace deliso {

struct PlyHeader {
  std::vector<std::string> comments;  // each of one line
  std::uint64_t vertices = 0, facets = 0;
  bool single_precision = false, ascii = false;
  const MeshAttributes* attributes = nullptr;
  std::optional<std::size_t> first_cap{};  // with attributes
};

class PlyWriter {
 public:
  // Writes the header. Keeps references.
  PlyWriter(AtomicFile& out, const PlyHeader& header);
  // All vertices of the header, then all facets.
  void vertex(const Vec3& p);
  void facet(const Triangle& t);

 private:
  // Writes a property; `last`: of its line.
  template <class T>
  void put(T value, bool last);

  AtomicFile& out_;
  const PlyHeader& header_;
  std::size_t next_vertex_ = 0, next_facet_ = 0;
};

}  // namespace deliso
