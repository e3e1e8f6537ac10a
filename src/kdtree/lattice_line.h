// SPDX-License-Identifier: MIT
// A line among voxels, and the walk along it (Amanatides and Woo 1987, made exact in its order).
//
// Units: voxels; sample (i,j,k) lies at (i,j,k). All decisions are comparisons of the parameters at
// which the line crosses lattice planes, and those come from one formula, so that every way of
// cutting up the line (by kd-tree nodes, by a walk, by clipping single voxels) finds the same
// pieces bit by bit:
//   L1  at_plane(axis, n) is monotone in n, rounding included (a difference and a product with a
//       constant are), and the reversed line's is its exact negative;
//   L2  so each parameter that is no crossing lies in exactly one voxel, and the voxels' pieces
//       [t0, t1] follow one another without gap or overlap;
//   L3  where one piece ends and the next begins, both voxels see the very same point: coordinates
//       across planes crossed there are exactly 0 or 1, the others are the same doubles.
// A line that runs in a lattice plane is in the voxel above it, at the box's far side below it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/box3.h"
#include "base/vec3.h"
#include "volume/volume.h"

namespace deliso {

// The piece of a line in one voxel: parameters t0 < t1, and the local coordinates there, in [0, 1].
struct VoxelSpan {
  Index3 voxel;
  double t0, t1;
  Vec3 u0, u1;
};

// Voxels lo .. hi-1 along each axis.
struct VoxelBox {
  Index3 lo, hi;
};

class LatticeLine {
 public:
  // origin + t * direction, in voxel units. Directions too small to invert count as zero.
  LatticeLine(const Vec3& origin, const Vec3& direction)
      : origin_{origin.x, origin.y, origin.z}, direction_{direction.x, direction.y, direction.z} {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      inverse_[axis] = 1 / direction_[axis];
      if (std::isfinite(inverse_[axis]) || std::isnan(direction_[axis])) continue;
      direction_[axis] = 0;
      inverse_[axis] = 0;
    }
  }

  bool is_finite() const {
    return std::isfinite(origin_[0] + origin_[1] + origin_[2] + direction_[0] + direction_[1] +
                         direction_[2]);
  }
  bool parallel(std::size_t axis) const { return inverse_[axis] == 0; }
  bool ascending(std::size_t axis) const { return inverse_[axis] > 0; }
  double origin(std::size_t axis) const { return origin_[axis]; }

  LatticeLine reversed() const {
    LatticeLine line = *this;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      line.direction_[axis] = -direction_[axis];
      line.inverse_[axis] = -inverse_[axis];
    }
    return line;
  }

  // Where the line crosses the plane number `plane` across `axis`. pre: !parallel(axis).
  double at_plane(std::size_t axis, int plane) const {
    return (plane - origin_[axis]) * inverse_[axis];
  }
  // Where it enters and leaves the slab between planes lo and hi.
  double enter(std::size_t axis, int lo, int hi) const {
    if (parallel(axis)) return -std::numeric_limits<double>::infinity();
    return at_plane(axis, ascending(axis) ? lo : hi);
  }
  double leave(std::size_t axis, int lo, int hi) const {
    if (parallel(axis)) return std::numeric_limits<double>::infinity();
    return at_plane(axis, ascending(axis) ? hi : lo);
  }

  // The part of `range` within the box; without interior (lo >= hi) when there is none. A line that
  // is not finite, or no line at all (no direction), has none.
  Range clip(Range range, const VoxelBox& box) const {
    if (!is_finite() || (parallel(0) && parallel(1) && parallel(2))) return {1, 0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int lo = box.lo[static_cast<int>(axis)], hi = box.hi[static_cast<int>(axis)];
      if (parallel(axis) && !(lo <= origin_[axis] && origin_[axis] <= hi)) return {1, 0};
      range.lo = std::max(range.lo, enter(axis, lo, hi));
      range.hi = std::min(range.hi, leave(axis, lo, hi));
    }
    return range;
  }

  // The index along `axis`, in lo .. hi-1, of the voxel that holds the line just after t. The guess
  // by position is put right by the crossings themselves (L2). pre: t in the box's range.
  int index_after(std::size_t axis, double t, int lo, int hi) const {
    const double position = origin_[axis] + t * direction_[axis];
    int n = position > lo ? position < hi ? static_cast<int>(position) : hi - 1 : lo;
    if (parallel(axis)) return n;
    const int step = ascending(axis) ? 1 : -1;
    const int first = ascending(axis) ? lo : hi - 1, last = ascending(axis) ? hi - 1 : lo;
    while (n != last && leave(axis, n, n + 1) <= t) n += step;
    while (n != first && enter(axis, n, n + 1) > t) n -= step;
    return n;
  }

  // Local coordinate at t in the voxel with index n along `axis`; exact on its planes (L3).
  double coordinate(std::size_t axis, int n, double t) const {
    if (t <= enter(axis, n, n + 1)) return ascending(axis) ? 0 : 1;
    if (t >= leave(axis, n, n + 1)) return ascending(axis) ? 1 : 0;
    return std::clamp(origin_[axis] + t * direction_[axis] - n, 0.0, 1.0);
  }

  VoxelSpan span(Index3 voxel, double t0, double t1) const {
    const auto at = [&](double t) {
      return Vec3{coordinate(0, voxel.i, t), coordinate(1, voxel.j, t), coordinate(2, voxel.k, t)};
    };
    return {voxel, t0, t1, at(t0), at(t1)};
  }

 private:
  std::array<double, 3> origin_, direction_, inverse_;
};

// The piece as the reversed line's: of the same voxel, run through the other way.
inline VoxelSpan reversed(const VoxelSpan& span) {
  return {span.voxel, -span.t1, -span.t0, span.u1, span.u0};
}

// Steps through the voxels of a box along a line, in order. Usage:
//   for (VoxelWalk walk(line, range, box); !walk.done(); walk.step()) ... walk.voxel() ...
class VoxelWalk {
 public:
  // pre: `range` came from line.clip, so that it lies in the box.
  VoxelWalk(const LatticeLine& line, Range range, const VoxelBox& box)
      : line_(line), t_(range.lo), end_(range.hi) {
    if (done()) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int a = static_cast<int>(axis);
      voxel_[axis] = line.index_after(axis, t_, box.lo[a], box.hi[a]);
      leave_[axis] = line.leave(axis, voxel_[axis], voxel_[axis] + 1);
    }
  }

  bool done() const { return !(t_ < end_); }
  Index3 voxel() const { return {voxel_[0], voxel_[1], voxel_[2]}; }
  double t() const { return t_; }
  double t_out() const { return std::min({leave_[0], leave_[1], leave_[2], end_}); }
  VoxelSpan span() const { return line_.span(voxel(), t_, t_out()); }

  void step() {
    t_ = t_out();
    if (done()) return;
    // A line through an edge or a corner crosses two or three planes at once.
    for (std::size_t axis = 0; axis < 3; ++axis) {
      while (leave_[axis] <= t_) {
        voxel_[axis] += line_.ascending(axis) ? 1 : -1;
        leave_[axis] = line_.leave(axis, voxel_[axis], voxel_[axis] + 1);
      }
    }
  }

 private:
  const LatticeLine& line_;
  std::array<int, 3> voxel_{};
  std::array<double, 3> leave_{};
  double t_, end_;
};

}  // namespace deliso
