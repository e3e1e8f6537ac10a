// SPDX-License-Identifier: MIT
// Reads a solid of tetrahedra: Medit's .mesh as text, and VTK's .vtu of one piece, in every
// encoding of VTK but LZ4 and LZMA.
//
//   R1  Any bytes give a solid or an InputError of one line. In a solid there are cells, corners
//       are below the number of points, and points are in_range (base/frame.h). Memory is bounded
//       by the file's size.
//   R2  Cells and triangles stay as they are; check_solid (check/check_solid.h) finds their faults.
//   R3  A cell's label is its reference or its value of `region`, 1 if there is none. Regions
//       are numbered from 1 on, in the order of the labels.
//   R4  Medit's triangles are walls. Their kind is the reference; their sides are not known, and
//   stay
//       outside. VTU has no walls.
//   R5  Of Medit's format, edges and marks of vertices are skipped; cells that are no tetrahedra
//   are
//       refused in both.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/solid/write_solid.h"

namespace deliso {

struct SolidFile {
  Solid solid;
  std::vector<std::int64_t> labels;  // of region r: labels[r - 1]
};

// Returns the solid in the file at `path`, whose ending decides the format.
SolidFile read_solid(const std::string& path);
// Returns the solid in `bytes`. Errors call the file `name`. pre: is_read(format).
SolidFile parse_solid(std::string_view bytes, SolidFormat format, const std::string& name);

}  // namespace deliso
