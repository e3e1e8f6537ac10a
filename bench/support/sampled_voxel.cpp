// SPDX-License-Identifier: MIT
#include "support/sampled_voxel.h"

#include <bit>

namespace deliso {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

// The corner of a cell at which one of its edges begins.
Index3 begin_of_edge(Index3 cell, int edge) {
  const int second = axis_after(edge / 4), third = axis_after(second);
  cell[second] += edge & 1;
  cell[third] += edge >> 1 & 1;
  return cell;
}

}  // namespace

SampledVoxel::SampledVoxel(const Volume& volume, double kappa, int n)
    : volume_(volume), kappa_(kappa), n_(n) {
  for (unsigned inside = 0; inside < 256; ++inside) {
    loops_[0][inside] = loops_of_cell(inside, AlternatingFaces::cut_off_inside);
    loops_[1][inside] = loops_of_cell(inside, AlternatingFaces::cut_off_outside);
    alternates_[inside] = has_alternating_face(inside);
  }
  const auto m = static_cast<std::size_t>(n + 1);
  rows_.resize(m * m);
  node_.assign(3 * m * m * m, kNone);
  for (int edge = 0; edge < 12; ++edge) {
    edge_offset_[static_cast<std::size_t>(edge)] = place(edge / 4, begin_of_edge({}, edge));
  }
}

bool SampledVoxel::sample(Index3 voxel) {
  voxel_ = voxel;
  Corners d = volume_.corners(voxel);
  int inside = 0;
  for (double& value : d) {
    value -= kappa_;
    inside += value >= 0 ? 1 : 0;
  }
  if (inside == 0 || inside == 8) return false;
  // Evaluates n^3 (g - kappa). A weight of 0 or n leaves nothing of the other sample. So on a face
  // the value is that of the face's samples, to the last bit, and the same for both voxels.
  const auto between = [this](double a, double b, int at) { return (n_ - at) * a + at * b; };
  for (int k = 0; k <= n_; ++k) {
    for (int j = 0; j <= n_; ++j) {
      std::array<double, 2> end;
      for (std::size_t x = 0; x < 2; ++x) {
        end[x] = between(between(d[x], d[x + 2], j), between(d[x + 4], d[x + 6], j), k);
      }
      std::uint64_t row = 0;
      for (int i = 0; i <= n_; ++i) {
        row |= static_cast<std::uint64_t>(between(end[0], end[1], i) >= 0) << i;
      }
      row_at(j, k) = row;
    }
  }
  return true;
}

const VoxelPieces& SampledVoxel::find_pieces(AlternatingFaces rule) {
  const auto& loops = loops_[rule == AlternatingFaces::cut_off_inside ? 0 : 1];
  pieces_.alternate = false;
  pieces_.on_box.clear();
  const std::uint64_t cells = (std::uint64_t{1} << n_) - 1;
  for (int k = 0; k < n_; ++k) {
    for (int j = 0; j < n_; ++j) {
      const std::array<std::uint64_t, 4> r{row_at(j, k), row_at(j + 1, k), row_at(j, k + 1),
                                           row_at(j + 1, k + 1)};
      const std::uint64_t any = r[0] | r[1] | r[2] | r[3], all = r[0] & r[1] & r[2] & r[3];
      for (std::uint64_t active = (any | any >> 1) & ~(all & all >> 1) & cells; active != 0;
           active &= active - 1) {
        const int i = std::countr_zero(active);
        unsigned inside = 0;
        for (unsigned s = 0; s < 4; ++s) {
          inside |= static_cast<unsigned>(r[s] >> i & 3) << (2 * s);
        }
        count_cell({i, j, k}, loops[inside]);
        if (alternates_[inside]) pieces_.alternate = true;
      }
    }
  }
  number_pieces();
  for (int axis = 0; axis < 3; ++axis) {
    list_face(axis, 0, pieces_.on_first_face[static_cast<std::size_t>(axis)]);
    list_face(axis, n_, pieces_.on_last_face[static_cast<std::size_t>(axis)]);
  }
  for (const std::size_t at : touched_) node_[at] = kNone;
  touched_.clear();
  crossings_.clear();
  quarters_.clear();
  return pieces_;
}

void SampledVoxel::count_cell(Index3 cell, const CellLoops& loops) {
  const unsigned box = box_faces(cell);
  const std::size_t at = place(0, cell);
  for (const std::vector<LoopStep>& loop : loops) {
    std::int64_t quarters = 4;
    std::uint32_t root = crossings_.root(node_of(at, loop.front().edge));
    for (const LoopStep& step : loop) {
      root = crossings_.unite(node_of(at, step.edge), root);
      const auto faces = faces_of_cell_edge(step.edge);
      quarters += 1 << ((box >> faces[0] & 1) + (box >> faces[1] & 1));
      quarters -= 2 << (box >> step.face & 1);
    }
    quarters_[root] += quarters;
    if (box == 0) continue;
    for (std::size_t s = 0; s < loop.size(); ++s) {
      if ((box >> loop[s].face & 1) == 0) continue;
      const int next = loop[(s + 1) % loop.size()].edge;
      // The piece is known as soon as all cells are counted: until then, the node.
      pieces_.on_box.push_back({number_in_volume(cell, loop[s].edge), number_in_volume(cell, next),
                                node_of(at, loop[s].edge)});
    }
  }
}

// Makes each set of crossings a piece.
void SampledVoxel::number_pieces() {
  pieces_.quarters.clear();
  piece_of_root_.assign(crossings_.size(), kNone);
  piece_of_.resize(crossings_.size());
  for (std::uint32_t node = 0; node < crossings_.size(); ++node) {
    std::uint32_t& piece = piece_of_root_[crossings_.root(node)];
    if (piece == kNone) {
      piece = static_cast<std::uint32_t>(pieces_.quarters.size());
      pieces_.quarters.push_back(0);
    }
    pieces_.quarters[piece] += quarters_[node];
    piece_of_[node] = piece;
  }
  for (VoxelPieces::BoxSegment& segment : pieces_.on_box) segment.piece = piece_of_[segment.piece];
}

void SampledVoxel::list_face(int axis, int at, std::vector<std::uint32_t>& pieces) const {
  pieces.clear();
  const int second = axis_after(axis), third = axis_after(second);
  Index3 p;
  p[axis] = at;
  for (const int along : {second, third}) {
    for (p[third] = 0; p[third] <= n_; ++p[third]) {
      for (p[second] = 0; p[second] <= n_; ++p[second]) {
        const std::uint32_t node = node_[place(along, p)];
        if (node != kNone) pieces.push_back(piece_of_[node]);
      }
    }
  }
}

// The faces of the box on which the cell lies.
unsigned SampledVoxel::box_faces(Index3 cell) const {
  const Index3 voxels = volume_.voxels();
  unsigned faces = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (voxel_[axis] == 0 && cell[axis] == 0) faces |= 1u << (2 * axis);
    if (voxel_[axis] == voxels[axis] - 1 && cell[axis] == n_ - 1) faces |= 2u << (2 * axis);
  }
  return faces;
}

// The place of a cell's edge among all edges of the voxel's cells, by its axis and beginning.
std::size_t SampledVoxel::place(int axis, Index3 begin) const {
  const auto m = static_cast<std::size_t>(n_ + 1);
  const auto at = [&](int a) { return static_cast<std::size_t>(begin[a]); };
  return ((static_cast<std::size_t>(axis) * m + at(2)) * m + at(1)) * m + at(0);
}

std::uint32_t SampledVoxel::node_of(std::size_t cell_place, int edge) {
  const std::size_t at = cell_place + edge_offset_[static_cast<std::size_t>(edge)];
  if (node_[at] == kNone) {
    node_[at] = crossings_.add();
    quarters_.push_back(0);
    touched_.push_back(at);
  }
  return node_[at];
}

std::uint64_t SampledVoxel::number_in_volume(Index3 cell, int edge) const {
  const Index3 begin = begin_of_edge(cell, edge), voxels = volume_.voxels();
  const auto n = static_cast<std::uint64_t>(n_);
  auto number = static_cast<std::uint64_t>(edge / 4);
  for (int axis = 0; axis < 3; ++axis) {
    number *= static_cast<std::uint64_t>(voxels[axis]) * n + 1;
    number +=
        static_cast<std::uint64_t>(voxel_[axis]) * n + static_cast<std::uint64_t>(begin[axis]);
  }
  return number;
}

std::uint64_t& SampledVoxel::row_at(int j, int k) {
  return rows_[static_cast<std::size_t>(j) +
               static_cast<std::size_t>(k) * static_cast<std::size_t>(n_ + 1)];
}

}  // namespace deliso
