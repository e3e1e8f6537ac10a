// SPDX-License-Identifier: MIT
#include "support/pair_searches.h"

#include "isosurface/lattice_line.h"

namespace deliso {

PairSearches::PairSearches(const Volume& volume, double kappa) : volume_(volume) {
  const Index3 n = volume.voxels();
  is_active_.resize(voxel_number(volume.dims(), {0, 0, n.k}));
  split({{0, 0, 0}, {n.i, n.j, n.k}}, kappa);
}

void PairSearches::split(const Node& node, double kappa) {
  const auto side = [&](std::size_t axis) { return node.hi[axis] - node.lo[axis]; };
  if (side(0) * side(1) * side(2) > 2) {
    std::size_t axis = 0;
    for (const std::size_t other : {1u, 2u}) {
      if (side(other) > side(axis)) axis = other;
    }
    Node low = node, high = node;
    low.hi[axis] = high.lo[axis] = (node.lo[axis] + node.hi[axis]) / 2;
    split(low, kappa);
    split(high, kappa);
    return;
  }
  bool has_inside = false, has_outside = false;
  const Index3 first{node.lo[0], node.lo[1], node.lo[2]}, end{node.hi[0], node.hi[1], node.hi[2]};
  for_each_place(first, end, [&](Index3 p) {
    (volume_.sample(p.i, p.j, p.k) >= kappa ? has_inside : has_outside) = true;
  });
  for (const Index3& voxel : {first, end + Index3{-1, -1, -1}}) {
    is_active_[voxel_number(volume_.dims(), voxel)] = has_inside && has_outside;
  }
}

void PairSearches::count(const Segment& r, bool found) {
  const VoxelUnits units(volume_);
  const LatticeLine line = units.line(r.a, r.direction());
  const Range range = line.clip({0, 1});
  std::size_t crossed = 0;
  if (range.lo < range.hi) {
    const Index3 first = line.voxel_after(range.lo, units.box());
    for (VoxelWalk walk(line, first, range); !walk.done(); walk.step()) {
      crossed += is_active_[voxel_number(volume_.dims(), walk.voxel())];
    }
  }
  counters_ += {1, found, crossed, found ? crossed : 0};
}

}  // namespace deliso
