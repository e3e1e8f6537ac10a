// SPDX-License-Identifier: MIT
// Makes T finer in some voxels. The pass over the voxels is unchanged, and with it components and
// summary; only a voxel's pieces in the mesh change:
//   - A split voxel has the pieces of its cells (contour/fine_voxel.h).
//   - A whole voxel beside a split one follows the crossings on the face between them. So its loops
//   have more vertices, and its stars and bands more triangles.
// Cells have one of two sizes, and a whole voxel lies between split voxels of unlike cells.
// The voxel that meets a face first numbers the crossings inside it, in the order that both voxels
// share. The other voxel needs only the first of these ids.
#pragma once

#include <array>
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
  // True if the set has the voxel; voxels outside the volume are in no set.
  bool contains(Index3 voxel) const;

 private:
  Index3 voxels_;
  std::vector<std::size_t> row_;  // row n is column_[row_[n] .. row_[n + 1])
  std::vector<int> column_;
};

// The voxels to split: their cells have the voxel's topology.
struct ChosenVoxels {
  SplitVoxels listed, elsewhere;

  std::size_t size() const { return listed.size() + elsewhere.size(); }
};
ChosenVoxels choose_split_voxels(const Volume& volume, double kappa, const ContourSplit& split);

// Meshes voxels, some of them in cells.
class SplitMesher final : public ContourSink {
 public:
  // Keeps a reference to `chosen`.
  SplitMesher(ContourMesh& mesh, const Volume& volume, double kappa, const ChosenVoxels& chosen,
              const ContourSplit& split);

  // Reserves memory. A split voxel adds about as many crossings as a layer of its cells has cells.
  void expect(std::size_t crossings) override {
    for (const Size& size : sizes_) crossings += size.voxels.size() * size.cells_of_layer;
    mesher_.expect(crossings);
  }
  VertexId crossing(int axis, Index3 sample, double c0, double c1,
                    std::uint8_t box_faces) override {
    return mesher_.crossing(axis, sample, c0, c1, box_faces);
  }
  void voxel(const VoxelPieces& pieces) override;

  // Replaces the segments of split voxels by those of their cells.
  void replace_boundary(std::vector<BoundarySegment>& segments) override;

 private:
  // Cells of one size, and the current voxel cut into them.
  struct Size {
    Size(const SplitVoxels& split, Index3 factor);

    const SplitVoxels& voxels;
    std::size_t cells_of_layer;
    FineVoxel fine;
    std::vector<VertexId> vertex;      // by slot
    std::vector<std::uint32_t> label;  // by piece
  };
  // The faces of a voxel, a bit each, by the size of the cells at them.
  using FacesBySize = std::array<int, 2>;

  // Returns the size of the voxel's cells; null for whole voxels.
  Size* size_of(Index3 voxel);
  VertexId& first_on_face(int axis, Index3 low_voxel);
  void number_face(Size& size, Index3 voxel, int f);
  VertexId add_crossing(const Size& size, Index3 voxel, FineVoxel::Slot slot, int box_faces);
  bool mesh_cells(Size& size, const VoxelPieces& pieces);  // true if their triangles might cross
  void mesh_beside(const VoxelPieces& pieces, const FacesBySize& faces);
  void add_boundary(const Size& size, const VoxelPieces& pieces);

  PieceMesher mesher_;
  std::array<Size, 2> sizes_;
  Index3 voxels_;
  std::vector<VertexId> first_across_y_, first_across_z_;  // first ids on the faces ahead
  VertexId first_across_x_ = kNoId;
  std::vector<BoundarySegment> boundary_;
  std::vector<VertexId> replaced_;  // start vertices of replaced segments
};

}  // namespace deliso
