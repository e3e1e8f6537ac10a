// SPDX-License-Identifier: MIT
// A grid of blocks whose planes lie at equal shares of the surface's work, so that many threads do
// not wait for one heavy block. It follows from the samples and the isovalue alone.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "blocks/block.h"
#include "blocks/grid.h"

namespace deliso {

// Bounds of a block's sides within the box of the surface. What lies empty around it goes to the
// outermost blocks, so a volume padded with zeros has the same blocks where the surface is.
inline constexpr int kLeastBlockSamples = 24, kMostBlockVoxels = 128;

// About how much work the surface is in boxes of a volume. The unit is the work of a grid edge that
// it crosses.
class SurfaceWork {
 public:
  static constexpr int kCellVoxels = 8;

  // Looks at one row of samples in 16, with the rows beside it. Reads the source in slabs unless it
  // is in memory.
  SurfaceWork(const VolumeSource& source, double isovalue, int threads);

  // Returns the work in the box. pre: its sides are at multiples of kCellVoxels, or at the last
  // sample.
  std::uint64_t in(const SampleBox& box) const;
  SampleBox all() const { return {{0, 0, 0}, voxels_}; }
  // Returns the box of the cells with work, at multiples of kCellVoxels: its end may lie beyond the
  // last sample. Empty if there is none.
  const SampleBox& active() const { return active_; }

 private:
  std::size_t at(Index3 corner) const {
    return corner.i + (cells_.i + 1) * (corner.j + (cells_.j + 1) * std::size_t(corner.k));
  }
  template <class Sample>
  void add_layer(const Volume& slab, const Sample* samples, Sample threshold, int k);
  void sum_up();
  void find_active();

  Index3 voxels_, cells_;
  SampleBox active_;
  std::vector<std::uint64_t> sums_;  // per corner of a cell: the work between it and sample 0
};

// Returns the grid. The more planes there are, the less work has the heaviest block, and the more
// is done at seams; the sum of both is least. Blocks below 8,000 crossed edges are never divided
// for it, and those above 200,000 if they can be.
BlockGrid grid_at_equal_shares(const SurfaceWork& work);

}  // namespace deliso
