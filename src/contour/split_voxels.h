// SPDX-License-Identifier: MIT
// T made finer in some voxels. The pass over the voxels stays as it is, and with it components and
// summary; only what a voxel puts into the mesh changes:
//   - a split voxel puts in the pieces of its cells (contour/fine_voxel.h);
//   - a voxel beside a split one follows that one's crossings on the face between them, so its
//     loops have more vertices, and its stars and bands more triangles.
// The voxel that meets a face first names the crossings inside it, in the order both voxels share;
// the other needs no more than the first of these ids.
#pragma once

#include <cstdint>
#include <vector>

#include "contour/contour.h"
#include "contour/contour_stream.h"
#include "contour/fine_voxel.h"
#include "contour/piece_mesher.h"

namespace deliso {

// A set of voxels, by rows.
class SplitVoxels {
 public:
  // `numbers` ascending.
  SplitVoxels(Index3 dims, const std::vector<std::uint64_t>& numbers);

  std::size_t size() const { return column_.size(); }
  // Voxels outside the volume are in no set.
  bool contains(Index3 voxel) const;

 private:
  Index3 voxels_;
  std::vector<std::size_t> row_;  // row n is column_[row_[n] .. row_[n + 1])
  std::vector<int> column_;
};

// The voxels that are to be split and whose cells agree with them.
SplitVoxels choose_split_voxels(const Volume& volume, double kappa, const ContourSplit& split);

// A sink of ContourStream.
class SplitMesher {
 public:
  SplitMesher(ContourMesh& mesh, const Volume& volume, const SplitVoxels& split, Index3 factor);

  // A split voxel adds about as many crossings as one layer of its cells has cells.
  void expect(std::size_t crossings) {
    mesher_.expect(crossings + split_.size() * static_cast<std::size_t>(cells_of_layer_));
  }
  VertexId crossing(int axis, Index3 sample, double c0, double c1, std::uint8_t box_faces) {
    return mesher_.crossing(axis, sample, c0, c1, box_faces);
  }
  void voxel(const VoxelPieces& pieces);

  // Puts the segments of cells in place of those of the voxels they belong to.
  void replace_boundary(std::vector<BoundarySegment>& segments) const;

 private:
  VertexId& first_on_face(int axis, Index3 low_voxel);
  void name_face(Index3 voxel, int f);
  VertexId add_crossing(Index3 voxel, FineVoxel::Slot slot, int box_faces);
  void mesh_cells(const VoxelPieces& pieces);
  void mesh_beside(const VoxelPieces& pieces, int faces);
  void add_boundary(const VoxelPieces& pieces);

  PieceMesher mesher_;
  const SplitVoxels& split_;
  FineVoxel fine_;
  Index3 voxels_;
  int cells_of_layer_;
  std::vector<VertexId> vertex_;                           // by slot, of the voxel at hand
  std::vector<std::uint32_t> label_;                       // by piece, of the voxel at hand
  std::vector<VertexId> first_across_y_, first_across_z_;  // first ids on the faces ahead
  VertexId first_across_x_ = kNoId;
  std::vector<BoundarySegment> boundary_;
  std::vector<VertexId> replaced_;  // start vertices of segments that are replaced
};

}  // namespace deliso
