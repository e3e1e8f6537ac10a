// SPDX-License-Identifier: MIT
// Searches in a kd-tree that asks for kappa only down to pairs of voxels, the parents of leaves of
// one voxel. Which nodes the paper asks it does not say; the program asks each voxel.
#pragma once

#include <array>
#include <vector>

#include "isosurface/isosurface.h"
#include "volume/volume.h"

namespace deliso {

class PairSearches {
 public:
  // Halves the box of voxels across its longest side, down to nodes of two voxels or one. Keeps a
  // reference.
  PairSearches(const Volume& volume, double kappa);

  // Counts a search along r as Sigma::intersect does: every voxel on r whose pair is active costs a
  // computation. `found`: r meets Sigma.
  void count(const Segment& r, bool found);
  const SearchCounters& counters() const { return counters_; }

 private:
  struct Node {
    std::array<int, 3> lo, hi;  // voxels lo .. hi-1
  };
  void split(const Node& node, double kappa);

  const Volume& volume_;
  std::vector<bool> is_active_;  // by voxel: its pair is
  SearchCounters counters_;
};

}  // namespace deliso
