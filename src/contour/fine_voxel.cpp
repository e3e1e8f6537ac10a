// SPDX-License-Identifier: MIT
#include "contour/fine_voxel.h"

#include <algorithm>

namespace deliso {
namespace {

// The share of a part by which lattice planes stand off the equal division: no simple fraction
// (F3).
constexpr double kPlaneOffset = 0.0618;

}  // namespace

FineVoxel::FineVoxel(Index3 factor) : factor_(factor) {
  for (int axis = 0; axis < 3; ++axis) {
    DELISO_CHECK(factor[axis] >= 1);
    for (int n = 0; n <= factor[axis]; ++n) {
      const bool end = n == 0 || n == factor[axis];
      plane_[axis].push_back((n + (end ? 0 : kPlaneOffset)) / factor[axis]);
    }
  }
  const auto points = [&](int axis) { return static_cast<std::uint32_t>(factor[axis] + 1); };
  stride_ = {1, points(0), points(0) * points(1)};
  values_.resize(std::size_t{stride_[2]} * points(2));
  inside_.resize(values_.size());
  on_edge_.resize(3 * values_.size());
  next_.resize(3 * values_.size());
  pieces_ = DisjointSets(3 * values_.size());
  euler_.resize(3 * values_.size());
  for (int m = 0; m < 8; ++m) corner_offset_[m] = point({m & 1, m >> 1 & 1, m >> 2});
  for (int e = 0; e < 12; ++e) {
    edge_offset_[e] = 3 * corner_offset_[corners_of_edge(e)[0]] + static_cast<std::uint32_t>(e / 4);
  }
  sort_lattice_edges();
}

void FineVoxel::sort_lattice_edges() {
  for_each_place({}, factor_, [&](Index3 p) {
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] == factor_[axis]) continue;
      const Slot slot = 3 * point(p) + static_cast<Slot>(axis);
      int sides = 0, face = 0, edge = 4 * axis, bit = 1;
      for (int other = 0; other < 3; ++other) {
        if (other == axis) continue;
        const bool high = p[other] == factor_[other];
        if (high) edge += bit;
        bit *= 2;
        if (!high && p[other] != 0) continue;
        ++sides;
        face = 2 * other + high;
      }
      (sides == 2   ? edge_parts_[edge]
       : sides == 1 ? face_edges_[face]
                    : inner_edges_)
          .push_back(slot);
      all_edges_.push_back(slot);
      on_edge_[slot] = sides == 2;
    }
  });
}

void FineVoxel::load(const Corners& c) {
  const auto between = [](double a, double b, double t) { return a * (1 - t) + b * t; };
  for (int i = 0; i <= factor_.i; ++i) {
    const double x = plane_[0][i];
    const double c00 = between(c[0], c[1], x), c10 = between(c[2], c[3], x);
    const double c01 = between(c[4], c[5], x), c11 = between(c[6], c[7], x);
    for (int j = 0; j <= factor_.j; ++j) {
      const double y = plane_[1][j];
      const double low = between(c00, c10, y), high = between(c01, c11, y);
      for (int k = 0; k <= factor_.k; ++k) {
        const double value = between(low, high, plane_[2][k]);
        const std::uint32_t at = point({i, j, k});
        values_[at] = value;
        inside_[at] = value >= 0;
      }
    }
  }
  std::fill(next_.begin(), next_.end(), kNoId);
  segments_ = 0;
  cells_.clear();
  trace();
}

FineVoxel::Slot FineVoxel::crossed_part(int e) const {
  const auto& parts = edge_parts_[e];
  const auto found =
      std::find_if(parts.begin(), parts.end(), [&](Slot s) { return is_crossed(s); });
  DELISO_CHECK(found != parts.end());
  return *found;
}

std::span<const FineVoxel::Slot> FineVoxel::crossed(const std::vector<Slot>& slots) {
  crossed_.clear();
  for (const Slot slot : slots) {
    if (is_crossed(slot)) crossed_.push_back(slot);
  }
  return crossed_;
}

Vec3 FineVoxel::crossing(Slot slot) const {
  const int axis = static_cast<int>(slot % 3);
  const std::uint32_t low = slot / 3;
  const std::uint32_t index[3] = {low % stride_[1], low % stride_[2] / stride_[1],
                                  low / stride_[2]};
  Vec3 p{plane_[0][index[0]], plane_[1][index[1]], plane_[2][index[2]]};
  const double c0 = values_[low], c1 = values_[low + stride_[axis]];
  const double t = std::clamp(c0 / (c0 - c1), kCrossingMargin, 1 - kCrossingMargin);
  p[axis] += t * (plane_[axis][index[axis] + 1] - p[axis]);
  return p;
}

CellFrame FineVoxel::frame(const Cell& cell) const {
  CellFrame f;
  for (int axis = 0; axis < 3; ++axis) {
    const int n = cell.at[axis];
    f.low[axis] = plane_[axis][n];
    f.size[axis] = plane_[axis][n + 1] - plane_[axis][n];
  }
  return f;
}

void FineVoxel::link_segments(const Cell& cell) {
  const VoxelLoops& loops = cell.loops;
  const unsigned outer = outer_faces(cell.at, factor_);
  for (int l = 0; l < loops.count; ++l) {
    const int first = loops.first[l], end = loops.first[l + 1];
    for (int n = first; n < end; ++n) {
      const Slot from = slot(cell, loops.edge[n]);
      const Slot to = slot(cell, loops.edge[n + 1 < end ? n + 1 : first]);
      pieces_.unite(from, to);
      if ((outer >> loops.face[n] & 1) == 0) continue;
      next_[from] = to;
      ++segments_;
    }
  }
  if (!cell.tube) return;
  pieces_.unite(slot(cell, loops.edges(cell.tube.a)[0]), slot(cell, loops.edges(cell.tube.b)[0]));
}

void FineVoxel::trace() {
  pieces_.reset();
  Cell cell;
  for_each_place({}, factor_ + Index3{-1, -1, -1}, [&](Index3 at) {
    cell.at = at;
    const std::uint32_t low = point(at);
    for (int m = 0; m < 8; ++m) cell.corners[m] = values_[low + corner_offset_[m]];
    const int mask = mask_of(cell.corners);
    if (mask == 0 || mask == 255) return;
    const VoxelValues values(cell.corners, 0);
    cell.loops = voxel_loops(mask, values);
    cell.tube = find_tube(mask, values, cell.loops);
    cells_.push_back(cell);
    link_segments(cell);
  });
}

// Two edges of a voxel have at most one face in common. So a chain from one crossing of the voxel
// to the next on its loop lies on the right face. Segments outside such chains would be other
// curves.
bool FineVoxel::faces_agree(const VoxelLoops& loops) const {
  std::size_t walked = 0;
  for (int l = 0; l < loops.count; ++l) {
    const auto edges = loops.edges(l);
    for (std::size_t n = 0; n < edges.size(); ++n) {
      Slot end{};
      for_each_after(edges[n], [&](Slot slot) {
        end = slot;
        ++walked;
      });
      if (end != crossed_part(edges[(n + 1) % edges.size()])) return false;
    }
  }
  return walked == segments_;
}

bool FineVoxel::agrees_with(const VoxelLoops& loops, Tube tube) {
  if (!faces_agree(loops)) return false;
  std::array<Slot, kMaxLoops> root{};
  for (int l = 0; l < loops.count; ++l) {
    root[l] = piece(crossed_part(loops.edges(l)[0]));
    for (int m = 0; m < l; ++m) {
      const bool joined = tube && m == tube.a && l == tube.b;
      if ((root[l] == root[m]) != joined) return false;
    }
  }
  // V - E + F of each piece. Segments are counted twice: two cells see a segment between them, one
  // cell sees a segment on the voxel's surface.
  std::fill(euler_.begin(), euler_.end(), 0);
  for (const Slot s : all_edges_) {
    if (!is_crossed(s)) continue;
    const Slot r = piece(s);
    if (std::find(root.begin(), root.begin() + loops.count, r) == root.begin() + loops.count) {
      return false;  // unreachable: pieces end in loops
    }
    euler_[r] += next_[s] != kNoId ? 2 - 1 : 2;
  }
  for (const Cell& cell : cells_) {
    for (int l = 0; l < cell.loops.count; ++l) {
      const auto edges = cell.loops.edges(l);
      const bool disk = !cell.tube || (l != cell.tube.a && l != cell.tube.b);
      euler_[piece(slot(cell, edges[0]))] += (disk ? 2 : 0) - static_cast<int>(edges.size());
    }
  }
  for (int l = 0; l < loops.count; ++l) {
    const bool in_tube = tube && (l == tube.a || l == tube.b);
    if (euler_[root[l]] != (in_tube ? 0 : 2)) return false;
  }
  return true;
}

}  // namespace deliso
