// SPDX-License-Identifier: MIT
// Makes T finer in some voxels. The pass over the voxels is unchanged, and with it components and
// summary; only a voxel's pieces in the mesh change:
//   - A split voxel has the pieces of its cells (contour/fine_voxel.h).
//   - A whole voxel beside a split one follows the crossings on the face between them. So its loops
//   have more vertices, and its stars and bands more triangles.
// The voxel that meets a face first numbers the crossings inside it, in the order that both voxels
// share. The other voxel needs only the first of these ids.
#pragma once

#include <cstdint>
#include <vector>

#include "contour/contour.h"

namespace deliso {

// Where T is to be finer. A split voxel is cut into i x j x k cells, whose corners have the
// interpolant's values. Its pieces are those of its cells.
struct ContourSplit {
  std::vector<std::uint64_t> voxels{};  // voxel_number()s of active voxels, ascending
  Index3 factor{4, 4, 4};               // cells of each listed voxel, >= 1
  // Cells of each other voxel. These stay whole: voxels of the list `whole`, ascending; those
  // across a face from a listed one, so that no face has two lattices; and those at a seam that the
  // cells would cut, since the block beside it must have the same vertices there.
  Index3 usual{1, 1, 1};
  std::vector<std::uint64_t> whole{};
};

// Returns T, made finer as `split` says. I1-I6 and the topology of the plain T hold, component by
// component. The two summaries are equal: they count crossings and pieces of voxels, not of cells.
// The plain T's crossings of grid edges are vertices here too, at the same places and in the same
// order. A voxel beside a split one keeps its pieces, with more vertices on their loops. Boundary
// chains go from cell to cell. Rounding might give the cells of a voxel another topology than the
// voxel's (a face's saddle at kappa, to the last bits). Such a voxel stays whole: then there is
// another pass over the volume.
ContourMesh build_contour(const Volume& volume, double kappa, ContourSplit split);

}  // namespace deliso
