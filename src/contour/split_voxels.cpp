// SPDX-License-Identifier: MIT
#include "contour/split_voxels.h"

#include <algorithm>
#include <utility>

namespace deliso {
namespace {

// A sink that keeps the numbers of the active voxels whose cells agree with them.
class SplitChooser final : public ContourSink {
 public:
  SplitChooser(Index3 dims, Index3 factor) : dims_(dims), fine_(factor) {}

  VertexId crossing(int, Index3, double, double, std::uint8_t) override { return kNoId; }
  void voxel(const VoxelPieces& p) override { consider(p.voxel, p.corners, p.loops, p.tube); }

  void consider(Index3 voxel, const Corners& c, const VoxelLoops& loops, Tube tube) {
    fine_.load(c);
    fine_.trace();
    if (fine_.agrees_with(loops, tube)) numbers.push_back(voxel_number(dims_, voxel));
  }

  std::vector<std::uint64_t> numbers;

 private:
  Index3 dims_;
  FineVoxel fine_;
};

// Returns the faces of the voxel that Sigma crosses.
int crossed_faces(const VoxelLoops& loops) {
  int faces = 0;
  for (int n = 0; n < loops.first[loops.count]; ++n) faces |= 1 << loops.face[n];
  return faces;
}

SplitVoxels choose_listed(const Volume& volume, double kappa, const ContourSplit& split) {
  const Index3 dims = volume.dims();
  if (split.voxels.empty()) return SplitVoxels(dims, {});
  DELISO_CHECK(std::is_sorted(split.voxels.begin(), split.voxels.end()));
  DELISO_CHECK(split.voxels.back() <= voxel_number(dims, {dims.i - 2, dims.j - 2, dims.k - 2}));
  SplitChooser chooser(dims, split.factor);
  std::uint64_t previous = ~std::uint64_t{0};
  for (const std::uint64_t number : split.voxels) {
    if (number == previous) continue;
    previous = number;
    const Index3 voxel = numbered_voxel(dims, number);
    const VoxelValues values(volume.corners(voxel), kappa);
    const int mask = mask_of(values.above);
    if (mask == 0 || mask == 255) continue;
    VoxelLoops scratch;
    const VoxelLoops& loops = voxel_loops(mask, values, scratch);
    chooser.consider(voxel, values.above, loops, find_tube(mask, values, loops));
  }
  return SplitVoxels(dims, chooser.numbers);
}

// True if the voxel has a face in a seam: the next block does not know the crossings of its cells.
bool lies_at_seam(const Volume& volume, Index3 voxel) {
  const Index3 last = volume.voxels();
  for (int f = 0; f < 6; ++f) {
    if ((volume.inner_faces() >> f & 1) == 0) continue;
    if (voxel[f >> 1] == ((f & 1) != 0 ? last[f >> 1] - 1 : 0)) return true;
  }
  return false;
}

SplitVoxels choose_elsewhere(const Volume& volume, double kappa, Index3 factor,
                             const SplitVoxels& listed) {
  const Index3 dims = volume.dims();
  if (factor == Index3{1, 1, 1}) return SplitVoxels(dims, {});
  SplitChooser chooser(dims, factor);
  walk_contour(volume, kappa, chooser);
  std::erase_if(chooser.numbers, [&](std::uint64_t number) {
    const Index3 voxel = numbered_voxel(dims, number);
    bool excluded = listed.contains(voxel) || lies_at_seam(volume, voxel);
    for (int f = 0; f < 6; ++f) excluded |= listed.contains(voxel_across(voxel, f));
    return excluded;
  });
  return SplitVoxels(dims, chooser.numbers);
}

}  // namespace

SplitVoxels::SplitVoxels(Index3 dims, const std::vector<std::uint64_t>& numbers)
    : voxels_{dims.i - 1, dims.j - 1, dims.k - 1} {
  if (numbers.empty()) return;
  const auto length = static_cast<std::uint64_t>(voxels_.i);
  row_.resize(static_cast<std::size_t>(voxels_.j) * static_cast<std::size_t>(voxels_.k) + 1);
  column_.reserve(numbers.size());
  for (const std::uint64_t n : numbers) {
    ++row_[n / length + 1];
    column_.push_back(static_cast<int>(n % length));
  }
  for (std::size_t r = 1; r < row_.size(); ++r) row_[r] += row_[r - 1];
}

bool SplitVoxels::contains(Index3 voxel) const {
  if (column_.empty() || voxel.j < 0 || voxel.j >= voxels_.j || voxel.k < 0 ||
      voxel.k >= voxels_.k) {
    return false;
  }
  const std::size_t r = static_cast<std::size_t>(voxel.j) +
                        static_cast<std::size_t>(voxels_.j) * static_cast<std::size_t>(voxel.k);
  const auto begin = column_.begin();
  return std::binary_search(begin + static_cast<std::ptrdiff_t>(row_[r]),
                            begin + static_cast<std::ptrdiff_t>(row_[r + 1]), voxel.i);
}

ChosenVoxels choose_split_voxels(const Volume& volume, double kappa, const ContourSplit& split) {
  SplitVoxels listed = choose_listed(volume, kappa, split);
  SplitVoxels elsewhere = choose_elsewhere(volume, kappa, split.elsewhere, listed);
  return {std::move(listed), std::move(elsewhere)};
}

SplitMesher::Size::Size(const SplitVoxels& split, Index3 factor)
    : voxels(split),
      cells_of_layer(static_cast<std::size_t>(
          (factor.i * factor.j + factor.j * factor.k + factor.k * factor.i) / 3)),
      fine(factor),
      vertex(fine.slots()),
      label(fine.slots()) {}

SplitMesher::SplitMesher(ContourMesh& mesh, const Volume& volume, double kappa,
                         const ChosenVoxels& chosen, const ContourSplit& split)
    : mesher_(mesh, volume, kappa),
      sizes_{Size(chosen.listed, split.factor), Size(chosen.elsewhere, split.elsewhere)},
      voxels_(volume.voxels()) {
  first_across_y_.resize(static_cast<std::size_t>(voxels_.i), kNoId);
  first_across_z_.resize(first_across_y_.size() * static_cast<std::size_t>(voxels_.j), kNoId);
}

SplitMesher::Size* SplitMesher::size_of(Index3 voxel) {
  for (Size& size : sizes_) {
    if (size.voxels.contains(voxel)) return &size;
  }
  return nullptr;
}

void SplitMesher::voxel(const VoxelPieces& p) {
  Size* const own = size_of(p.voxel);
  const int crossed = crossed_faces(p.loops);
  FacesBySize faces{};
  for (int f = 0; f < 6; ++f) {
    if ((crossed >> f & 1) == 0) continue;
    const Size* const size = own != nullptr ? own : size_of(voxel_across(p.voxel, f));
    if (size != nullptr) faces[static_cast<std::size_t>(size - sizes_.data())] |= 1 << f;
  }
  if (faces == FacesBySize{}) {
    mesher_.voxel(p);
    return;
  }
  for (std::size_t s = 0; s < sizes_.size(); ++s) {
    if (faces[s] == 0) continue;
    Size& size = sizes_[s];
    size.fine.load(p.corners);
    for (int n = 0; n < p.loops.first[p.loops.count]; ++n) {
      size.vertex[size.fine.crossed_part(p.loops.edge[n])] = p.vertex[n];
    }
  }
  // Face by face: the low face along x takes the id that the high face leaves for the next voxel.
  for (int f = 0; f < 6; ++f) {
    for (std::size_t s = 0; s < sizes_.size(); ++s) {
      if ((faces[s] >> f & 1) != 0) number_face(sizes_[s], p.voxel, f);
    }
  }
  mesher_.begin_voxel();
  bool crowded = true;
  if (own != nullptr) {
    crowded = mesh_cells(*own, p);
  } else {
    mesh_beside(p, faces);
  }
  mesher_.end_voxel(p.voxel, crowded);
}

// Returns the first id on the face between `low_voxel` and the next one along the axis.
VertexId& SplitMesher::first_on_face(int axis, Index3 low_voxel) {
  if (axis == 0) return first_across_x_;
  const auto i = static_cast<std::size_t>(low_voxel.i), j = static_cast<std::size_t>(low_voxel.j);
  return axis == 1 ? first_across_y_[i] : first_across_z_[i + first_across_y_.size() * j];
}

void SplitMesher::number_face(Size& size, Index3 voxel, int f) {
  const int axis = f >> 1;
  const bool high = (f & 1) != 0, on_box = voxel[axis] == (high ? voxels_[axis] - 1 : 0);
  const auto slots = size.fine.crossed_on_face(f);
  if (!high && !on_box) {
    VertexId id = first_on_face(axis, voxel);
    for (const auto slot : slots) size.vertex[slot] = id++;
    return;
  }
  for (const auto slot : slots)
    size.vertex[slot] = add_crossing(size, voxel, slot, on_box ? 1 << f : 0);
  if (!on_box) first_on_face(axis, voxel) = slots.empty() ? kNoId : size.vertex[slots[0]];
}

VertexId SplitMesher::add_crossing(const Size& size, Index3 voxel, FineVoxel::Slot slot,
                                   int box_faces) {
  const Vec3 u = size.fine.crossing(slot);
  return mesher_.add_at(mesher_.place(voxel) + u, static_cast<std::uint8_t>(box_faces));
}

bool SplitMesher::mesh_cells(Size& size, const VoxelPieces& p) {
  for (const auto slot : size.fine.crossed_inside())
    size.vertex[slot] = add_crossing(size, p.voxel, slot, 0);
  size.fine.trace();
  for (int l = 0; l < p.loops.count; ++l) {
    size.label[size.fine.piece(size.fine.crossed_part(p.loops.edges(l)[0]))] = p.label[l];
  }
  bool crowded = false;
  for (const FineVoxel::Cell& cell : size.fine.cells()) {
    CellFrame frame = size.fine.frame(cell);
    frame.low = frame.low + mesher_.place(p.voxel);
    const VoxelLoops& loops = cell.loops;
    VoxelPieces pieces(p.voxel, cell.corners, loops, cell.tube);
    for (int n = 0; n < loops.first[loops.count]; ++n) {
      pieces.vertex[n] = size.vertex[size.fine.slot(cell, loops.edge[n])];
    }
    for (int l = 0; l < loops.count; ++l) {
      pieces.label[l] = size.label[size.fine.piece(size.fine.slot(cell, loops.edges(l)[0]))];
    }
    mesher_.cell(frame, pieces, p);
    crowded |= PieceMesher::is_crowded(loops);
  }
  add_boundary(size, p);
  return crowded;
}

// Only split voxels have cells on the box, so only they call this.
void SplitMesher::add_boundary(const Size& size, const VoxelPieces& p) {
  for (int l = 0; l < p.loops.count; ++l) {
    for (int n = p.loops.first[l]; n < p.loops.first[l + 1]; ++n) {
      const std::uint8_t face = p.loops.face[n];
      const int axis = face >> 1;
      if (p.voxel[axis] != ((face & 1) != 0 ? voxels_[axis] - 1 : 0)) continue;
      replaced_.push_back(p.vertex[n]);
      const int following = n + 1 < p.loops.first[l + 1] ? n + 1 : p.loops.first[l];
      for (auto slot = size.fine.crossed_part(p.loops.edge[n]);
           size.vertex[slot] != p.vertex[following];) {
        const auto next = size.fine.next(slot);
        boundary_.push_back({size.vertex[slot], size.vertex[next], p.label[l], face});
        slot = next;
      }
    }
  }
}

void SplitMesher::mesh_beside(const VoxelPieces& p, const FacesBySize& faces) {
  std::array<Size*, 6> size_at{};
  for (int f = 0; f < 6; ++f) {
    for (std::size_t s = 0; s < sizes_.size(); ++s) {
      if ((faces[s] >> f & 1) == 0) continue;
      size_at[f] = &sizes_[s];
      sizes_[s].fine.trace_face(f);
    }
  }
  std::array<std::vector<VertexId>, kMaxLoops> loop;
  bool follows = false;  // a neighbor's crossings lie on its faces
  for (int l = 0; l < p.loops.count; ++l) {
    for (int n = p.loops.first[l]; n < p.loops.first[l + 1]; ++n) {
      loop[l].push_back(p.vertex[n]);
      const Size* const size = size_at[p.loops.face[n]];
      if (size == nullptr) continue;
      const int following = n + 1 < p.loops.first[l + 1] ? n + 1 : p.loops.first[l];
      auto slot = size->fine.next(size->fine.crossed_part(p.loops.edge[n]));
      for (; size->vertex[slot] != p.vertex[following]; slot = size->fine.next(slot)) {
        loop[l].push_back(size->vertex[slot]);
        follows = true;
      }
    }
  }
  const CellFrame frame{mesher_.place(p.voxel), {1, 1, 1}};
  if (!follows) return mesher_.cell(frame, p, p);
  for (int l = 0; l < p.loops.count; ++l) {
    if (p.tube && l == p.tube.b) continue;
    if (p.tube && l == p.tube.a) {
      mesher_.tube(frame, p.corners, loop[l], loop[p.tube.b], p.label[l]);
    } else {
      mesher_.disk(frame, p.corners, loop[l], p.label[l]);
    }
  }
}

void SplitMesher::replace_boundary(std::vector<BoundarySegment>& segments) {
  std::vector<VertexId> starts = replaced_;
  std::sort(starts.begin(), starts.end());
  std::erase_if(segments, [&](const BoundarySegment& s) {
    return std::binary_search(starts.begin(), starts.end(), s.from);
  });
  segments.insert(segments.end(), boundary_.begin(), boundary_.end());
}

}  // namespace deliso
