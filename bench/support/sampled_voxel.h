// SPDX-License-Identifier: MIT
// One voxel by the signs of g - kappa at the corners of n x n x n cells: the pieces of the surface
// in it, of disks that the loops on the cells' faces bound (bench/support/cell_loops.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/cell_loops.h"
#include "volume/volume.h"

namespace deliso {

// Disjoint sets of the numbers 0, 1, ...
class Sets {
 public:
  std::uint32_t add() {
    parent_.push_back(size());
    return parent_.back();
  }
  std::uint32_t root(std::uint32_t a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  // Returns the root of both.
  std::uint32_t unite(std::uint32_t a, std::uint32_t b) { return parent_[root(a)] = root(b); }
  std::uint32_t size() const { return static_cast<std::uint32_t>(parent_.size()); }
  void clear() { parent_.clear(); }

 private:
  std::vector<std::uint32_t> parent_;
};

// Pieces are numbered from 0.
struct VoxelPieces {
  // A segment on the box of the volume, between two crossings by their numbers in the volume.
  struct BoxSegment {
    std::uint64_t from, to;
    std::uint32_t piece;
  };
  // By piece: the voxel's share of V - E + F, in quarters. A crossing is shared by four cells, on a
  // face of the box by two, on an edge of the box by one. A segment is shared by two cells, on the
  // box by one.
  std::vector<std::int64_t> quarters;
  // By axis: the piece of each crossing on the voxel's first and last face across the axis. Both
  // voxels at a face list its crossings in the same order.
  std::array<std::vector<std::uint32_t>, 3> on_first_face, on_last_face;
  std::vector<BoxSegment> on_box;
  // A cell has a face with alternating corners. Without one the pieces are those of either rule.
  bool alternate = false;
};

class SampledVoxel {
 public:
  // pre: 1 <= n <= 63.
  SampledVoxel(const Volume& volume, double kappa, int n);

  // Takes the signs in a voxel. Returns false if its corners have one sign: then there is no piece.
  bool sample(Index3 voxel);
  // Returns the pieces in the voxel that was sampled last.
  const VoxelPieces& find_pieces(AlternatingFaces rule);

 private:
  void count_cell(Index3 cell, const CellLoops& loops);
  void number_pieces();
  void list_face(int axis, int at, std::vector<std::uint32_t>& pieces) const;
  unsigned box_faces(Index3 cell) const;
  std::size_t place(int axis, Index3 begin) const;
  std::uint32_t node_of(std::size_t cell_place, int edge);
  std::uint64_t number_in_volume(Index3 cell, int edge) const;
  std::uint64_t& row_at(int j, int k);

  const Volume& volume_;
  double kappa_;
  int n_;
  std::array<std::array<CellLoops, 256>, 2> loops_;  // by rule and signs of the corners
  std::array<bool, 256> alternates_;
  std::array<std::size_t, 12> edge_offset_;  // from the place of a cell to that of its edge

  Index3 voxel_;
  std::vector<std::uint64_t> rows_;  // bit i of row j, k: inside
  std::vector<std::uint32_t> node_;  // by place: the crossing's node in crossings_
  std::vector<std::size_t> touched_;
  Sets crossings_;
  std::vector<std::int64_t> quarters_;                   // by node
  std::vector<std::uint32_t> piece_of_root_, piece_of_;  // by node
  VoxelPieces pieces_;
};

}  // namespace deliso
