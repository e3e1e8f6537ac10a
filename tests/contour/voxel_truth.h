// SPDX-License-Identifier: MIT
// What an oracle says of the topology of Sigma in one voxel.
#pragma once

#include <array>
#include <cstddef>
#include <numeric>
#include <vector>

namespace deliso {

struct VoxelPiece {
  int edges = 0;  // bit e: its boundary crosses the voxel's edge e
  int euler = 0;
  int loops = 0;
  friend auto operator<=>(const VoxelPiece&, const VoxelPiece&) = default;
};

struct VoxelTruth {
  bool resolved = false;
  std::vector<VoxelPiece> pieces;           // sorted
  std::array<std::array<int, 12>, 6> mate;  // [face][edge]: the crossing joined to it there, or -1
};

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void unite(int a, int b) { parent_[root(a)] = root(b); }

 private:
  std::vector<int> parent_;
};

}  // namespace deliso
