// SPDX-License-Identifier: MIT
#include "contour/split_voxels.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "base/sorted_list.h"
#include "contour/contour_stream.h"
#include "contour/fine_voxel.h"
#include "contour/piece_mesher.h"

namespace deliso {
namespace {

using VoxelNumbers = std::vector<std::uint64_t>;  // ascending

VoxelNumbers without(const VoxelNumbers& list, const VoxelNumbers& removed) {
  VoxelNumbers out;
  std::ranges::set_difference(list, removed, std::back_inserter(out));
  return out;
}

// Meshes voxels, some of them in cells.
class SplitMesher final : public ContourSink {
 public:
  // Keeps references to the volume and to the split.
  SplitMesher(ContourMesh& mesh, const Volume& volume, double kappa, const ContourSplit& split)
      : mesh_(mesh),
        mesher_(mesh, volume, kappa),
        split_(split),
        cells_{Cells(split.usual), Cells(split.factor)},
        seams_(seams_across(split.usual, volume)),
        grid_(volume),
        voxels_(volume.voxels()) {
    first_across_y_.resize(voxels_.i, kNoId);
    first_across_z_.resize(first_across_y_.size() * voxels_.j, kNoId);
  }

  // Split voxels whose cells have another topology. If there are any, the mesh is of no use.
  VoxelNumbers disagreeing;

  ContourId crossing(int axis, Index3 sample, double c0, double c1,
                     std::uint8_t box_faces) override {
    return mesher_.crossing(axis, sample, c0, c1, box_faces);
  }

  void voxel(const VoxelPieces& p) override {
    const Cut own = cut_of(p.voxel);
    const std::size_t crossings = p.loops.first[p.loops.count];
    CutFaces at{};
    for (std::size_t n = 0; n < crossings; ++n) {
      const int f = p.loops.face[n];
      at[f] = std::max(own, cut_of(voxel_across(p.voxel, f)));
    }
    if (at == CutFaces{}) return mesher_.voxel(p);
    for (const Cut cut : {Cut::usual, Cut::listed}) {
      if (std::ranges::find(at, cut) == at.end()) continue;
      Cells& c = cells(cut);
      c.fine.load(p.corners);
      for (std::size_t n = 0; n < crossings; ++n) {
        c.vertex[c.fine.crossed_part(p.loops.edge[n])] = p.vertex[n];
      }
    }
    if (own != Cut::whole && !cells(own).fine.agrees_with(p.loops, p.tube)) {
      disagreeing.push_back(voxel_number(grid_.dims(), p.voxel));
    }
    if (!disagreeing.empty()) return;
    // Face by face: the low face along x takes the id that the high face leaves for the next voxel.
    for (int f = 0; f < 6; ++f) {
      if (at[f] != Cut::whole) number_face(p.voxel, f, cells(at[f]));
    }
    mesher_.begin_voxel();
    bool crowded = true;
    if (own != Cut::whole) {
      mesh_.split_voxels += own == Cut::listed;
      crowded =
          mesh_cells(p, cells(own)) || (outer_faces(p.voxel, voxels_) & grid_.inner_faces()) != 0;
    } else {
      mesh_beside(p, at);
    }
    mesher_.end_voxel(p.voxel, crowded);
  }

  // Replaces the segments of split voxels by those of their cells.
  void replace_boundary(std::vector<BoundarySegment>& segments) override {
    std::vector<ContourId> starts = replaced_;
    std::sort(starts.begin(), starts.end());
    std::erase_if(segments, [&](const BoundarySegment& s) {
      return std::binary_search(starts.begin(), starts.end(), s.from);
    });
    segments.insert(segments.end(), boundary_.begin(), boundary_.end());
  }

 private:
  // The current voxel cut into cells.
  struct Cells {
    explicit Cells(Index3 factor) : fine(factor), vertex(fine.slots()), label(fine.slots()) {}

    FineVoxel fine;
    std::vector<ContourId> vertex;     // by slot
    std::vector<std::uint32_t> label;  // by piece
  };
  // How a voxel is cut. Between two voxels the face has the lattice of the one with more cells.
  enum class Cut : std::uint8_t { whole, usual, listed };
  using CutFaces = std::array<Cut, 6>;  // of a voxel, as far as Sigma crosses them
  Cells& cells(Cut cut) { return cells_[cut == Cut::listed]; }

  // Returns the inner faces of a block that the usual cells would cut.
  static unsigned seams_across(Index3 cells, const Volume& block) {
    unsigned faces = 0;
    for (BoxFace face = 0; face < 6; ++face) {
      const int axis = axis_of(face);
      const bool is_cut = cells[(axis + 1) % 3] > 1 || cells[(axis + 2) % 3] > 1;
      faces |= is_cut ? block.inner_faces() & 1u << face : 0;
    }
    return faces;
  }
  bool is_in(const VoxelNumbers& list, Index3 voxel) const {
    return grid_.has_voxel(voxel) &&
           std::ranges::binary_search(list, voxel_number(grid_.dims(), voxel));
  }
  Cut cut_of(Index3 voxel) const {
    if (is_in(split_.voxels, voxel)) return Cut::listed;
    if (split_.usual == Index3{1, 1, 1} || !grid_.has_voxel(voxel) || is_in(split_.whole, voxel) ||
        (outer_faces(voxel, voxels_) & seams_) != 0) {
      return Cut::whole;
    }
    for (int f = 0; f < 6 && !split_.voxels.empty(); ++f) {
      if (is_in(split_.voxels, voxel_across(voxel, f))) return Cut::whole;
    }
    return Cut::usual;
  }

  // Returns the first id on the face between `low_voxel` and the next one along the axis.
  ContourId& first_on_face(int axis, Index3 low_voxel) {
    if (axis == 0) return first_across_x_;
    const auto [i, j, k] = low_voxel;
    return axis == 1 ? first_across_y_[i] : first_across_z_[i + first_across_y_.size() * j];
  }

  void number_face(Index3 voxel, int f, Cells& cells) {
    const int axis = f >> 1;
    const bool high = (f & 1) != 0, on_box = (outer_faces(voxel, voxels_) >> f & 1) != 0;
    const auto slots = cells.fine.crossed_on_face(f);
    if (!high && !on_box) {
      ContourId id = first_on_face(axis, voxel);
      for (const auto slot : slots) cells.vertex[slot] = id++;
      return;
    }
    for (const auto slot : slots)
      cells.vertex[slot] = add_crossing(voxel, cells, slot, on_box ? 1 << f : 0);
    if (!on_box) first_on_face(axis, voxel) = slots.empty() ? kNoId : cells.vertex[slots[0]];
  }

  ContourId add_crossing(Index3 voxel, const Cells& cells, FineVoxel::Slot slot, int box_faces) {
    const Vec3 u = cells.fine.crossing(slot);
    return mesher_.add_at(mesher_.place(voxel) + u, static_cast<std::uint8_t>(box_faces));
  }

  // Returns true if the cells' triangles might cross.
  bool mesh_cells(const VoxelPieces& p, Cells& cells) {
    for (const auto slot : cells.fine.crossed_inside())
      cells.vertex[slot] = add_crossing(p.voxel, cells, slot, 0);
    for (int l = 0; l < p.loops.count; ++l) {
      cells.label[cells.fine.piece(cells.fine.crossed_part(p.loops.edges(l)[0]))] = p.label[l];
    }
    bool crowded = false;
    for (const FineVoxel::Cell& cell : cells.fine.cells()) {
      CellFrame frame = cells.fine.frame(cell);
      frame.low = frame.low + mesher_.place(p.voxel);
      const VoxelLoops& loops = cell.loops;
      VoxelPieces pieces(p.voxel, cell.corners, loops, cell.tube);
      for (int n = 0; n < loops.first[loops.count]; ++n) {
        pieces.vertex[n] = cells.vertex[cells.fine.slot(cell, loops.edge[n])];
      }
      for (int l = 0; l < loops.count; ++l) {
        pieces.label[l] = cells.label[cells.fine.piece(cells.fine.slot(cell, loops.edges(l)[0]))];
      }
      mesher_.cell(frame, pieces, p);
      crowded |= PieceMesher::is_crowded(loops);
    }
    add_boundary(p, cells);
    return crowded;
  }

  // Only split voxels have cells on the box, so only they call this.
  void add_boundary(const VoxelPieces& p, const Cells& cells) {
    const unsigned outer = outer_faces(p.voxel, voxels_);
    for (int l = 0; l < p.loops.count; ++l) {
      for (int n = p.loops.first[l]; n < p.loops.first[l + 1]; ++n) {
        const std::uint8_t face = p.loops.face[n];
        if ((outer >> face & 1) == 0) continue;
        replaced_.push_back(p.vertex[n]);
        ContourId from = p.vertex[n];
        cells.fine.for_each_after(p.loops.edge[n], [&](FineVoxel::Slot slot) {
          boundary_.push_back({from, cells.vertex[slot], p.label[l], face});
          from = cells.vertex[slot];
        });
      }
    }
  }

  void mesh_beside(const VoxelPieces& p, const CutFaces& at) {
    std::array<std::vector<ContourId>, kMaxLoops> loop;
    std::size_t vertices = 0;
    for (int l = 0; l < p.loops.count; ++l) {
      for (int n = p.loops.first[l]; n < p.loops.first[l + 1]; ++n) {
        loop[l].push_back(p.vertex[n]);
        const Cut cut = at[p.loops.face[n]];
        if (cut == Cut::whole) continue;
        const Cells& c = cells(cut);
        c.fine.for_each_after(p.loops.edge[n],
                              [&](FineVoxel::Slot slot) { loop[l].push_back(c.vertex[slot]); });
        loop[l].pop_back();  // the next of the voxel's own
      }
      vertices += loop[l].size();
    }
    const CellFrame frame{mesher_.place(p.voxel), {1, 1, 1}};
    // Without a neighbor's crossings on its faces it is as any voxel.
    if (vertices == p.loops.first[p.loops.count]) return mesher_.cell(frame, p, p);
    mesher_.fill(frame, p, [&](int l) { return std::span<const ContourId>(loop[l]); });
  }

  ContourMesh& mesh_;
  PieceMesher mesher_;
  const ContourSplit& split_;
  std::array<Cells, 2> cells_;  // usual ones, and those of listed voxels
  const unsigned seams_;        // faces with plain seams
  const Grid& grid_;
  const Index3 voxels_;
  std::vector<ContourId> first_across_y_, first_across_z_;  // first ids on the faces ahead
  ContourId first_across_x_ = kNoId;
  std::vector<BoundarySegment> boundary_;
  std::vector<ContourId> replaced_;  // start vertices of replaced segments
};

}  // namespace

ContourMesh build_contour(const Volume& volume, double kappa, ContourSplit split) {
  if (split.voxels.empty() && split.usual == Index3{1, 1, 1}) return build_contour(volume, kappa);
  while (true) {
    ContourMesh mesh;
    SplitMesher mesher(mesh, volume, kappa, split);
    WalkResult found = walk_contour(volume, kappa, mesher);
    if (mesher.disagreeing.empty()) {
      complete(mesh, std::move(found), volume.inner_faces());
      return mesh;
    }
    split.whole = united(split.whole, without(mesher.disagreeing, split.voxels));
    split.voxels = without(split.voxels, mesher.disagreeing);
  }
}

}  // namespace deliso
