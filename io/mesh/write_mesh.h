// SPDX-License-Identifier: MIT
// Writes a triangle mesh as PLY, OFF, OBJ, STL or VTP.
//
// The same mesh gives the same bytes on every machine: numbers in text are the shortest that read
// back the same (no locale), binary is little endian, and nothing of the time or place goes in.
// Files appear whole or not at all (io/files/atomic_file.h); `-` is standard output.
//
// A comment goes into the head of the file as one line of its own: PLY `comment`, OFF and OBJ `#`,
// an XML comment in VTP, behind the rest of STL's 80 bytes where it fits there. What cannot stand
// in all of these (bytes that are not printable ASCII, `\`, a second `-` in a row) is written as
// `?`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/seam_vertex.h"
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

struct MeshWriteOptions {
  std::optional<MeshFormat> format{};  // absent: by the path's ending, PLY on standard output
  bool single_precision = false;       // coordinates as float instead of double (STL always is)
  bool ascii = false;                  // PLY only
  bool sync = false;                   // wait until the bytes are on the medium
  std::string comment{};               // empty: none
  // PLY only: of a part of a mesh; an element `seam` behind the facets.
  std::vector<SeamVertex> seam{};
};

// Whether coordinates are rounded to float: where that is asked for, and by STL. pre:
// options.format.
bool writes_single_precision(const MeshWriteOptions& options);
// The points as the file will hold them: in the world, and rounded where it rounds.
// pre: options.format.
std::vector<Vec3> written_points(const TriMesh& mesh, const MeshWriteOptions& options);

// A part as its file holds it; the facets are not linked.
struct PartMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<SeamVertex> seam;
};
PartMesh written_part(const TriMesh& mesh, const MeshWriteOptions& options);

// In world coordinates: the mesh's frame is applied. Its space is written as SPACE=RAS or LPS where
// it is known, in VTP as field data, where 3D Slicer looks for it; not in OFF.
// Throws InputError on an unknown ending and on every fault of the file system.
void write_mesh(const TriMesh& mesh, const std::string& path, const MeshWriteOptions& options = {});

}  // namespace deliso
