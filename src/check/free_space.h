// SPDX-License-Identifier: MIT
// Where Sigma is not: cubes around points. From the voxels that T passes through, in cells of 2^3
// voxels or more, each with its distance to the nearest such cell.
//
// Units: voxels. Sample (i,j,k) of the volume lies at (i,j,k).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "check/voxel_components.h"

namespace deliso {

class FreeSpace {
 public:
  FreeSpace(const VoxelComponents& voxels, const Volume& volume);

  struct Cube {
    Vec3 middle;
    double half = 0;  // of its side
  };
  // Returns a cube around a point of the scaled frame whose inside Sigma does not meet. It is
  // smaller by more than the rounding of a point so far from those that it was computed from.
  Cube around(const Vec3& p, double far) const;

 private:
  std::size_t cell(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * rows_ + static_cast<std::size_t>(j)) * columns_ +
           static_cast<std::size_t>(i);
  }

  const Volume& volume_;
  int shift_ = 1;  // a cell has 2^shift_ voxels along each axis
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<std::uint8_t> distance_;  // per cell, in cells; 0 where T is
};

// True if the cubes cover the segment between their middles.
inline bool cover_segment(const FreeSpace::Cube& a, const FreeSpace::Cube& b) {
  const Vec3 d = a.middle - b.middle;
  return std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)}) < a.half + b.half;
}

}  // namespace deliso
