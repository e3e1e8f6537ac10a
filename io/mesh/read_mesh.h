// SPDX-License-Identifier: MIT
// Reads a triangle mesh from PLY (ASCII, binary of either byte order), OFF, OBJ, STL (binary,
// ASCII), VTP, binary glTF or 3MF. VTP is VTK XML PolyData of one piece, in every encoding of VTK
// but LZ4 and LZMA. Objects of a file are one mesh.
//
//   R1  Polygons are cut into triangles, in a fan from the first corner.
//   R2  Normals, textures, groups and further elements are skipped, and colors but for those that
//       write_mesh gives labels.
//   R3  Facets stay as they are, even with equal corners or edges of three facets; check_mesh
//       reports them.
//   R4  Any bytes give a mesh or an InputError. In a mesh, corners are below the vertex count and
//       points are in_range (base/frame.h). The error has one line: the file, the line, byte or
//       vertex, and the fault. Memory is bounded by the file's size (io/files/expansion_budget.h).
//   R5  Comments before the first number or statement are returned: the first 100 that are not
//       blank, without their mark and outer blanks. They may have any bytes. Binary STL has its 80
//       bytes, or the text that write_mesh put there; ASCII STL has its name. glTF has the
//       comment of write_mesh.
//   R6  STL has no vertices, and glTF has several at one place where normals or textures differ.
//       Corners at the same position, to the last bit of a float, become one, numbered in order of
//       occurrence. Normals are not read.
//   R7  Of VTP and glTF, polygons are read; vertices and lines are skipped, triangle strips are
//       refused. Data of glTF must be in the file itself, and not in a compression of an extension.
//   R8  The patient's space that the file names as write_mesh does is the frame's.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/files/expansion_budget.h"
#include "io/mesh/write_mesh.h"
#include "mesh/tri_mesh.h"

namespace deliso {

// Facts about a file beside its mesh.
struct MeshNotes {
  std::vector<std::string> comments;
  // The largest distance by which rounding to float may have moved a vertex about a point that is
  // not the origin (glTF). 0: coordinates are as the file has them.
  double rounding = 0;
  // Of each facet, or empty: the color (sRGB) that VTP, glTF and 3MF give it, or its object; and
  // the labels in front of it and behind, as write_mesh has them in PLY and VTP.
  std::vector<std::array<std::uint8_t, 3>> colors{};
  std::vector<std::array<std::int64_t, 2>> sides{};
};

// Returns the mesh in the file at `path`, with linked facets (link_faces). The path's ending
// decides the format; of standard input (`-`) the first bytes do. `notes`, if given, receives the
// file's.
TriMesh read_mesh(const std::string& path, MeshNotes* notes = nullptr);

// Returns the mesh in `bytes`. Errors call the file `name`. pre: is_read(format).
TriMesh parse_mesh(std::string_view bytes, MeshFormat format, const std::string& name,
                   MeshNotes* notes = nullptr, const ExpansionBudget& budget = {});

}  // namespace deliso
