// SPDX-License-Identifier: MIT
// Reads a triangle mesh from PLY (ASCII, binary of either byte order), OFF, OBJ, STL (binary,
// ASCII) or VTP (VTK XML PolyData of one piece, in every encoding that VTK writes but LZ4 and
// LZMA).
//
//   R1  polygons are cut into triangles that fan out from their first corner;
//   R2  what is not geometry (colors, normals, texture, groups, further elements) is skipped;
//   R3  facets are kept as they are, with corners twice or edges of three facets: check_mesh says;
//   R4  whatever the bytes, the outcome is a mesh whose corners are below the vertex count and
//       whose points are in_range (base/frame.h), or an InputError of one line that names the file,
//       the line, byte or vertex, and the fault. Memory follows what the file holds, never what it
//       promises;
//   R5  comments are handed back as far as they stand before the first number or statement, the
//       first 100 that are not blank, without their mark and the blanks around them. They may hold
//       any bytes. STL's are its 80 bytes, those that write_mesh adds to its own by themselves, or
//       the name of the ASCII kind;
//   R6  STL has no vertices of its own: corners at the same position, to the last bit of a float,
//       are one, counted in the order in which they come. Normals are not read;
//   R7  of VTP, polygons are read; vertices and lines are no geometry here (R2), triangle strips
//       are refused.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/write_mesh.h"
#include "mesh/tri_mesh.h"

namespace deliso {

// Reads the file at `path`, in the format of its ending. `-` is standard input, whose format is
// told from its first bytes. The facets are linked (link_faces). `comments`, when given, become the
// file's.
TriMesh read_mesh(const std::string& path, std::vector<std::string>* comments = nullptr);

// A part of a mesh from a PLY file; without a seam where the file has none.
PartMesh read_part(const std::string& path);
// The comments of a PLY file, of which only the header is read.
std::vector<std::string> read_ply_comments(const std::string& path);

// The same from memory; `name` stands for the file in errors.
TriMesh parse_mesh(std::string_view bytes, MeshFormat format, const std::string& name,
                   std::vector<std::string>* comments = nullptr);

}  // namespace deliso
