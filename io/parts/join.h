// SPDX-License-Identifier: MIT
// The meshes of a volume's blocks joined into one. A part's vertices on its seams are known by the
// grid edges they lie on (blocks/seam.h), so two parts have them in common; nothing is searched
// for, and no point is moved.
//
// Why the whole is right when the parts are: a part lies in its block, blocks meet in their faces
// only, and there a part has its seam alone (J2), the same in both (J1, checked here edge by edge).
// So nothing crosses that did not cross within a part, every edge of the seam has one triangle on
// either side, and pieces are joined as those of the surface are.
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

// Reads the parts, PLY files, in any order, and writes the whole as PLY to `output` (`-`: standard
// output). Parts are read one at a time, three times: memory is that of the largest part and of all
// seams. The result does not depend on the order of the paths.
// Throws InputError that names the file: for one that is no part, parts that are not of one mesh
// (other volume, isovalue, criteria, grid of blocks), a block missing or twice, seams that do not
// match, a part that is not, in each of the three times, what its note says.
Joined join_parts(std::span<const std::string> paths, const std::string& output,
                  bool single_precision, bool ascii);

}  // namespace deliso
