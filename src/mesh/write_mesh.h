// SPDX-License-Identifier: MIT
// Writes a triangle mesh as PLY, OFF, OBJ, STL or VTP.
//
// The same mesh gives the same bytes on every machine: numbers in text are the shortest that read
// back the same (no locale), binary is little endian, and nothing of the time or place goes in.
// Files appear whole or not at all (base/atomic_file.h); `-` is standard output.
//
// A comment goes into the head of the file as one line of its own: PLY `comment`, OFF and OBJ `#`,
// an XML comment in VTP, behind the rest of STL's 80 bytes where it fits there. What cannot stand
// in all of these (bytes that are not printable ASCII, `\`, a second `-` in a row) is written as
// `?`.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/vec3.h"
#include "mesh/tri_mesh.h"

namespace deliso {

enum class MeshFormat : std::uint8_t {
  ply,  // binary little endian, or ASCII when asked
  off,  // text, Geomview's
  obj,  // text, Wavefront's
  stl,  // binary: single precision triangles with normals, no sharing of vertices
  vtp,  // VTK XML PolyData with raw appended arrays, for ParaView and Slicer
};

// The format that the ending of `path` names, in any case. Throws InputError listing the endings.
MeshFormat mesh_format_of(std::string_view path);

// Where the scaled frame lies in the world: p goes to origin + p.x * axes[0] + p.y * axes[1] +
// p.z * axes[2]. With left_handed axes every triangle is turned round, so that normals keep
// pointing to the side where f < kappa.
struct WorldFrame {
  Vec3 origin{0, 0, 0};
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  // Whose x, y, z these are: "RAS" (towards right, anterior, superior), "LPS" or, not known, empty.
  // Written as SPACE=..., in VTP as field data, where 3D Slicer looks for it; not in OFF.
  std::string_view space{};

  Vec3 to_world(const Vec3& p) const {
    return origin + p.x * axes[0] + p.y * axes[1] + p.z * axes[2];
  }
  bool left_handed() const { return dot(cross(axes[0], axes[1]), axes[2]) < 0; }
};

struct MeshWriteOptions {
  std::optional<MeshFormat> format{};  // absent: by the path's ending, PLY on standard output
  bool single_precision = false;       // coordinates as float instead of double (STL always is)
  bool ascii = false;                  // PLY only
  bool sync = false;                   // wait until the bytes are on the medium
  WorldFrame frame{};
  std::string comment{};  // empty: none
};

// Throws InputError on an unknown ending and on every fault of the file system.
void write_mesh(const TriMesh& mesh, const std::string& path, const MeshWriteOptions& options = {});

}  // namespace deliso
