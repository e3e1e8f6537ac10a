// SPDX-License-Identifier: MIT
// Joins the meshes of a volume's blocks. A vertex on a seam is identified by its grid edge
// (blocks/seam.h), so two parts have it in common. Nothing is searched, and no point is moved.
//
// The whole is right if the parts are. A part lies in its block, and blocks meet only in their
// faces. There a part has only its seam (J2), the same in both parts (J1, checked here for every
// edge). So facets of different parts do not cross, and every edge of the seam has one facet on
// either side. The parts are connected as the surface is.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace deliso {

struct Joined {
  std::size_t parts = 0;
  std::uint64_t vertices = 0, triangles = 0;
  std::uint64_t seam_vertices = 0, seam_edges = 0;  // counted once each
};

// Reads the parts, PLY files, and writes the whole as PLY to `output` (`-`: standard output). Parts
// are read one at a time, three times, so memory is that of the largest part and all seams. The
// result does not depend on the order of the paths.
// Throws an InputError with the path for:
// - a file that is no part;
// - parts of different meshes: another volume, isovalue, criteria or grid of blocks;
// - a block that is missing or there twice;
// - seams that do not match;
// - a part that, in any of the three passes, differs from its note.
Joined join_parts(std::span<const std::string> paths, const std::string& output,
                  bool single_precision, bool ascii);

}  // namespace deliso
