// SPDX-License-Identifier: MIT
#include "contour/sheet_walk.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <tuple>

#include "base/triangle.h"

namespace deliso {
namespace {

// Returns the number that an edge of a voxel has in the voxel across face f, which has it too.
constexpr int edge_across(int edge, int f) {
  const int along = edge / 4, axis = f / 2;
  const bool is_first = axis == (along == 0 ? 1 : 0);
  return edge ^ (is_first ? 1 : 2);
}

// Returns the crossing of an edge, in voxels from the voxel's low corner.
Vec3 crossing(const VoxelValues& values, int edge) {
  const auto [m, n] = corners_of_edge(edge);
  Vec3 p = to_vec3(corner_of({}, m));
  p[edge / 4] = values.above[m] / (values.above[m] - values.above[n]);
  return p;
}

// How far a way on the sheet may leave the shortest one between two voxels, along the axes, and
// come back. A sheet without a fold does not leave it.
constexpr int kDetourVoxels = 1;

int distance_between(Index3 a, Index3 b) {
  return std::abs(a.i - b.i) + std::abs(a.j - b.j) + std::abs(a.k - b.k);
}

}  // namespace

// The order of a heap: the shortest way comes first, of these the one that has come the furthest,
// then the first in scan order.
bool SheetWalk::Step::is_after(const Step& a, const Step& b) {
  const auto key = [](const Step& s) {
    return std::tuple(s.steps + s.left, s.left, s.voxel.k, s.voxel.j, s.voxel.i, s.edge);
  };
  return key(a) > key(b);
}

SheetWalk::Pieces::Pieces(const Volume& volume, double kappa, Index3 voxel)
    : at(voxel), values(volume.corners(voxel), kappa) {
  const int mask = mask_of(values.above);
  loops = voxel_loops(mask, values);
  tube = find_tube(mask, values, loops);
}

int SheetWalk::Pieces::loop_with(int edge) const {
  int loop = 0;
  while (std::ranges::find(loops.edges(loop), edge) == loops.edges(loop).end()) ++loop;
  return loop;
}

int SheetWalk::Pieces::nearest(const Volume& volume, const Vec3& p) const {
  if (loops.count == 1) return 0;
  Vec3 u;
  for (int axis = 0; axis < 3; ++axis) u[axis] = volume.in_samples(p, axis) - at[axis];
  double least = std::numeric_limits<double>::infinity();
  int nearest = 0;
  for (int l = 0; l < loops.count; ++l) {
    const auto edges = loops.edges(l);
    Vec3 middle;
    for (const int e : edges) middle = middle + crossing(values, e);
    middle = middle / static_cast<double>(edges.size());
    for (std::size_t n = 0; n < edges.size(); ++n) {
      const double d2 = distance2_to_triangle(u, middle, crossing(values, edges[n]),
                                              crossing(values, edges[(n + 1) % edges.size()]));
      if (d2 < least) least = d2, nearest = piece_of(l);
    }
  }
  return nearest;
}

std::uint8_t& SheetWalk::visited(Index3 voxel) {
  const auto at = [&](int axis) { return static_cast<std::size_t>(voxel[axis] - low_[axis]); };
  return visited_[at(0) + size_.i * (at(1) + size_.j * at(2))];
}

// Adds the voxels to which the piece goes on, after so many steps, to those ahead.
void SheetWalk::walk_on(const Pieces& from, int piece, int steps, Index3 last) {
  for (int l = 0; l < from.loops.count; ++l) {
    if (from.piece_of(l) != piece) continue;
    for (int n = from.loops.first[l]; n < from.loops.first[l + 1]; ++n) {
      const Index3 next = voxel_across(from.at, from.loops.face[n]);
      const int left = distance_between(next, last);
      if (steps + 1 + left > most_steps_ || !volume_.has_voxel(next)) continue;
      const int edge = edge_across(from.loops.edge[n], from.loops.face[n]);
      ahead_.push_back({steps + 1, left, next, edge});
      std::ranges::push_heap(ahead_, Step::is_after);
    }
  }
}

bool SheetWalk::leads(const Vec3& p, const Vec3& q) {
  if (!volume_.box().contains(p)) return true;
  const Index3 first = volume_.voxel_at(p), last = volume_.voxel_at(q);
  const Pieces begin(volume_, kappa_, first);
  if (begin.loops.count == 0) return true;
  const int from = begin.nearest(volume_, p);
  if (first == last) return from == begin.nearest(volume_, q);
  const Pieces end(volume_, kappa_, last);
  if (end.loops.count == 0) return false;
  const int to = end.nearest(volume_, q);
  most_steps_ = distance_between(first, last) + 2 * kDetourVoxels;
  std::size_t voxels = 1;
  for (int axis = 0; axis < 3; ++axis) {
    low_[axis] = std::min(first[axis], last[axis]) - kDetourVoxels;
    size_[axis] = std::abs(first[axis] - last[axis]) + 1 + 2 * kDetourVoxels;
    voxels *= static_cast<std::size_t>(size_[axis]);
  }
  visited_.assign(voxels, 0);
  ahead_.clear();
  visited(first) |= 1 << from;
  walk_on(begin, from, 0, last);
  while (!ahead_.empty()) {
    std::ranges::pop_heap(ahead_, Step::is_after);
    const Step step = ahead_.back();
    ahead_.pop_back();
    if (step.voxel == last && end.piece_of(end.loop_with(step.edge)) == to) return true;
    const Pieces here(volume_, kappa_, step.voxel);
    const int piece = here.piece_of(here.loop_with(step.edge));
    std::uint8_t& seen = visited(step.voxel);
    if ((seen >> piece & 1) != 0) continue;
    seen |= 1 << piece;
    walk_on(here, piece, step.steps, last);
  }
  return false;
}

}  // namespace deliso
