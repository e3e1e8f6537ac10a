// SPDX-License-Identifier: MIT
// The grid of blocks: planes of samples cut a volume into boxes of voxels. It follows from the
// volume, the isovalue and the desired side, never from threads, so the mesh does not depend on
// them.
// Neighboring blocks share the plane of samples between them.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "volume/volume_source.h"

namespace deliso {

struct BlockGrid {
  // Per axis the planes of samples between which the blocks lie, first and last included.
  std::array<std::vector<int>, 3> planes;
  // True for a grid of equal sides. In one that follows the surface the volume may be padded.
  bool ends_count = false;

  // Cuts the volume into equal parts along each axis, of about `side` voxels; 0: does not cut it.
  BlockGrid(const Grid& volume, int side);
  explicit BlockGrid(std::array<std::vector<int>, 3> given) : planes(std::move(given)) {}
  // Returns the boxes between neighboring planes: the cells. Rows along x, and layers of rows, are
  // passed back and forth, so each cell but the first shares a face with the one before it, and
  // those of a run that meet at an edge meet at faces, too.
  std::vector<SampleBox> boxes() const;
  Index3 cells() const;  // along each axis
  // Returns the distance of inner plane n across an axis from the nearest other inner plane, and
  // from the volume's ends if they count.
  int room_at(int axis, std::size_t n) const;
  bool is_divided() const { return cells() != Index3{1, 1, 1}; }
  Index3 cell_of(Index3 voxel) const;        // by its place in the grid
  std::size_t number_of(Index3 cell) const;  // in the order of boxes()
};

// The N-th of M contiguous runs of a grid's cells, counted from 1: what one process meshes.
struct PartChoice {
  int number = 1, of = 1;
  friend bool operator==(const PartChoice&, const PartChoice&) = default;
};
struct CellRun {
  std::size_t begin = 0, end = 0;
  bool holds(std::size_t cell) const { return begin <= cell && cell < end; }
};
CellRun cells_of(PartChoice part, std::size_t cells);

// Returns about how many voxels a block has along each axis in a grid of equal sides: a fifth of
// the volume's longest side, but 64 to 128. Where volumes are larger facets are too, and seams
// would cost more vertices.
int usual_block_side(const Grid& volume);

}  // namespace deliso
