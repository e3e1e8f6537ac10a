// SPDX-License-Identifier: MIT
// A voxel cut into cells. The trilinear interpolant is unchanged. So the cells, each treated like a
// voxel, hold the same surface in finer pieces.
//
//   F1  Lattice values are interpolated along x, then y, then z, with weights 1 and 0 at the
//       voxel's faces. Two voxels get the same doubles on their common face, so they agree on every
//       crossing and segment there (contour/voxel_topology.h).
//   F2  Along an edge the values are monotonic, rounding included. So a crossed edge of the voxel
//       is crossed once, in one of its parts.
//   F3  Lattice planes stand slightly off the equal division. Samples are often integers and
//       isovalues often halfway between, which would put Sigma through lattice points.
//
// A slot is a lattice edge's number: 3 * (its lower point) + axis.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/disjoint_sets.h"
#include "contour/piece_mesher.h"
#include "contour/voxel_topology.h"
#include "volume/volume.h"

namespace deliso {

class FineVoxel {
 public:
  using Slot = std::uint32_t;

  // A cell that Sigma crosses.
  struct Cell {
    Index3 at;
    Corners corners;
    VoxelLoops loops;
    Tube tube;
  };

  explicit FineVoxel(Index3 factor);  // pre: each component >= 1

  std::size_t slots() const { return next_.size(); }

  // Loads the voxel with these corners (values minus kappa), and traces the segments of all cells.
  void load(const Corners& c);

  // Returns the crossed part of edge e of the voxel. pre: the values at the edge's ends differ in
  // sign.
  Slot crossed_part(int e) const;
  // Returns the crossed lattice edges inside face f, in an order that both voxels at the face
  // share. Valid until the next call of this or of crossed_inside.
  std::span<const Slot> crossed_on_face(int f) { return crossed(face_edges_[f]); }
  // Returns the crossed lattice edges inside the voxel. Valid as above.
  std::span<const Slot> crossed_inside() { return crossed(inner_edges_); }

  // Returns where Sigma crosses the lattice edge, in the voxel's own coordinates, [0, 1].
  Vec3 crossing(Slot slot) const;

  // Calls visit(slot) along the loop on the voxel's surface, after the crossing of the voxel's edge
  // e up to that of the next one.
  template <class Visit>
  void for_each_after(int e, Visit&& visit) const {
    Slot s = crossed_part(e);
    do {
      s = next_[s];
      visit(s);
    } while (!on_edge_[s]);
  }
  std::span<const Cell> cells() const { return cells_; }
  CellFrame frame(const Cell& cell) const;  // in the voxel's own coordinates
  Slot slot(const Cell& cell, int e) const { return 3 * point(cell.at) + edge_offset_[e]; }
  // Returns the piece of the voxel's Sigma that a crossing belongs to: one slot represents the
  // piece.
  Slot piece(Slot slot) { return pieces_.find(slot); }

  // True if the cells have the voxel's topology: the same connections on its faces, no other curves
  // there, and inside the same pieces, disks and tube.
  bool agrees_with(const VoxelLoops& loops, Tube tube);

 private:
  std::uint32_t point(Index3 p) const {
    return static_cast<std::uint32_t>(p.i) + stride_[1] * static_cast<std::uint32_t>(p.j) +
           stride_[2] * static_cast<std::uint32_t>(p.k);
  }
  bool is_crossed(Slot slot) const {
    const std::uint32_t low = slot / 3;
    return inside_[low] != inside_[low + stride_[slot % 3]];
  }
  std::span<const Slot> crossed(const std::vector<Slot>& slots);
  void sort_lattice_edges();
  void trace();
  void link_segments(const Cell& cell);
  bool faces_agree(const VoxelLoops& loops) const;

  Index3 factor_;
  std::array<std::uint32_t, 3> stride_;
  std::array<std::vector<double>, 3> plane_;  // coordinates of lattice planes along each axis
  std::array<std::uint32_t, 8> corner_offset_;
  std::array<Slot, 12> edge_offset_;
  std::array<std::vector<Slot>, 12> edge_parts_;
  std::array<std::vector<Slot>, 6> face_edges_;
  std::vector<Slot> inner_edges_, all_edges_;
  std::vector<std::uint8_t> on_edge_;  // by slot: is it part of an edge of the voxel?

  std::vector<double> values_;
  std::vector<std::uint8_t> inside_;
  std::vector<Slot> crossed_;
  std::vector<Slot> next_;
  std::size_t segments_ = 0;  // traced on the voxel's surface
  DisjointSets pieces_;       // of crossings
  std::vector<Cell> cells_;
  std::vector<int> euler_;  // by root, scratch of agrees_with
};

}  // namespace deliso
