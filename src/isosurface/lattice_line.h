// SPDX-License-Identifier: MIT
// A line among voxels, and the walk along it (Amanatides and Woo 1987, with an exact order).
//
// Units: voxels; sample (i,j,k) lies at (i,j,k). Along an axis of uneven steps the unit is that of
// the scaled frame, and a table has the planes. All decisions compare parameters at which the line
// crosses lattice planes. One formula gives these parameters. So every way of cutting the line
// (kd-tree nodes, a walk, clipping single voxels) finds the same pieces bit by bit.
//   L1  at_plane(axis, n) is monotone in n, rounding included: a difference and a product with a
//       constant are. The reversed line's value is its exact negative.
//   L2  Hence a parameter that is no crossing lies in exactly one voxel. The voxels' pieces [t0,
//       t1] follow one another without gap or overlap.
//   L3  Where one piece ends and the next begins, both voxels see the same point. Its coordinates
//       across the planes crossed there are exactly 0 or 1; the others are the same doubles.
// A line in a lattice plane is in the voxel above the plane, at the box's far side in the one
// below.
//
// Branch predictors cannot guess the signs of directions. So they enter as numbers (`ahead`), and
// values are selected by index.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/box3.h"
#include "base/vec3.h"
#include "volume/volume.h"

namespace deliso {

// std::min and std::max take references and compile to branches; these do not.
constexpr double smaller(double a, double b) {
  return a < b ? a : b;
}
constexpr double greater(double a, double b) {
  return a > b ? a : b;
}

// The piece of a line in one voxel: parameters t0 < t1 and the local coordinates at both, in [0,
// 1].
struct VoxelSpan {
  Index3 voxel;
  double t0, t1;
  Vec3 u0, u1;
  bool empty() const { return !(t0 < t1); }
};

// Returns the piece as the reversed line sees it: the same voxel, passed in the other direction.
inline VoxelSpan reversed(const VoxelSpan& span) {
  return {span.voxel, -span.t1, -span.t0, span.u1, span.u0};
}

// The places of the planes along each axis of uneven steps, else null (Grid::places).
using Planes = std::array<const double*, 3>;

// The voxels lo .. hi-1 along each axis.
struct VoxelBox {
  std::array<int, 3> lo, hi;
};

class LatticeLine {
 public:
  // The line origin + t * direction, in voxel units, among `voxels` voxels. Components of the
  // direction too small to invert count as zero. Keeps the pointers to planes.
  LatticeLine(const Vec3& origin, const Vec3& direction, Index3 voxels, const Planes& planes = {})
      : voxels_{voxels.i, voxels.j, voxels.k},
        planes_(planes),
        is_even_(planes == Planes{}),
        origin_{origin.x, origin.y, origin.z},
        direction_{direction.x, direction.y, direction.z},
        base_(origin_) {
    const double sum = origin.x + origin.y + origin.z + direction.x + direction.y + direction.z;
    valid_ = std::isfinite(sum);
    if (!valid_) return;
    bool moves = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      inverse_[axis] = 1 / direction_[axis];
      ahead_[axis] = inverse_[axis] > 0;
      if (std::isfinite(inverse_[axis])) {
        moves = true;
        continue;
      }
      // Parallel to the planes. base_ becomes the middle of the line's layer of voxels. Then
      // at_plane puts all planes below it at minus infinity and all above at plus infinity.
      base_[axis] = middle_of_layer(axis);
      direction_[axis] = 0;
      inverse_[axis] = std::numeric_limits<double>::infinity();
      ahead_[axis] = 1;
    }
    set_sides();
    valid_ = moves;
  }

  // True if the line is finite and has a direction. pre of all functions below but clip.
  bool valid() const { return valid_; }

  LatticeLine reversed() const {
    LatticeLine line = *this;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      line.direction_[axis] = -direction_[axis];
      line.inverse_[axis] = -inverse_[axis];
      line.ahead_[axis] = 1 - ahead_[axis];
    }
    line.set_sides();
    return line;
  }

  // Returns the parameter where the line crosses plane number `plane` across `axis`; infinite if
  // parallel.
  double at_plane(std::size_t axis, int plane) const {
    return (place_of(axis, plane) - base_[axis]) * inverse_[axis];
  }
  // Returns 1 if indices along `axis` grow with t, else 0.
  int ahead(std::size_t axis) const { return ahead_[axis]; }
  // Return where the line enters and leaves the layer of voxels with index n.
  double enter(std::size_t axis, int n) const { return at_plane(axis, n + 1 - ahead_[axis]); }
  double leave(std::size_t axis, int n) const { return at_plane(axis, n + ahead_[axis]); }

  // Returns the part of `range` in the box of all voxels. Its interior is empty (lo >= hi) if there
  // is none, or if the line is invalid.
  Range clip(Range range) const {
    if (!valid_) return {1, 0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int far = ahead_[axis] * voxels_[axis], near = voxels_[axis] - far;
      range.lo = greater(range.lo, at_plane(axis, near));
      range.hi = smaller(range.hi, at_plane(axis, far));
    }
    return range;
  }
  bool starts_inside() const {
    const auto is_within = [&](std::size_t axis) {
      return place_of(axis, 0) <= origin_[axis] && origin_[axis] <= place_of(axis, voxels_[axis]);
    };
    return valid_ && is_within(0) && is_within(1) && is_within(2);
  }

  // Returns the index along `axis`, in lo .. hi-1, of the voxel that holds the line just after t.
  // The position gives a guess; the crossings correct it (L2). pre: t is in the range of lo .. hi.
  int index_after(std::size_t axis, double t, int lo, int hi) const {
    const double position = origin_[axis] + t * direction_[axis];
    int n = planes_[axis] ? lo + gap_at(planes_[axis] + lo, hi - lo + 1, position)
                          : static_cast<int>(greater(smaller(position, hi - 1.0), lo));
    const int step = 2 * ahead_[axis] - 1;
    while (leave(axis, n) <= t && lo <= n + step && n + step < hi) n += step;
    while (enter(axis, n) > t && lo <= n - step && n - step < hi) n -= step;
    return n;
  }
  // Returns the voxel that holds the line just after t = 0. pre: starts_inside().
  Index3 voxel_after_origin() const {
    const auto index = [&](std::size_t axis) {
      // A line that runs down from a plane begins in the voxel below it.
      const int n = planes_[axis] ? gap_at(planes_[axis], voxels_[axis] + 1, origin_[axis])
                                  : static_cast<int>(origin_[axis]);
      const int below = ahead_[axis] == 0 && origin_[axis] == place_of(axis, n);
      return std::max(std::min(n - below, voxels_[axis] - 1), 0);
    };
    return {index(0), index(1), index(2)};
  }
  // Returns the voxel of `box` that holds the line just after t. pre: as index_after.
  Index3 voxel_after(double t, const VoxelBox& box) const {
    return {index_after(0, t, box.lo[0], box.hi[0]), index_after(1, t, box.lo[1], box.hi[1]),
            index_after(2, t, box.lo[2], box.hi[2])};
  }

  // Returns the piece of `range` in the voxel; empty if there is none.
  VoxelSpan span(Index3 voxel, Range range) const {
    const std::array<int, 3> n = {voxel.i, voxel.j, voxel.k};
    std::array<double, 3> low, high, in, out;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = place_of(axis, n[axis]);
      high[axis] = place_of(axis, n[axis] + 1);
      const std::array<double, 2> ends = {high[axis], low[axis]};
      in[axis] = (ends[ahead_[axis]] - base_[axis]) * inverse_[axis];
      out[axis] = (ends[1 - ahead_[axis]] - base_[axis]) * inverse_[axis];
    }
    const double t0 = greater(greater(in[0], in[1]), greater(in[2], range.lo));
    const double t1 = smaller(smaller(out[0], out[1]), smaller(out[2], range.hi));
    // On the planes the coordinates are exact (L3).
    const auto at = [&](std::size_t axis, double t, bool on_plane, double side) {
      const double along = origin_[axis] + t * direction_[axis];
      const double within = greater(smaller(along, high[axis]), low[axis]);
      const std::array<double, 2> either = {within - low[axis], side};
      return either[on_plane];
    };
    const auto entry = [&](std::size_t axis) {
      return at(axis, t0, in[axis] >= t0, entry_side_[axis]);
    };
    const auto exit = [&](std::size_t axis) {
      return at(axis, t1, t1 >= out[axis], exit_side_[axis]);
    };
    VoxelSpan span{voxel, t0, t1, {entry(0), entry(1), entry(2)}, {exit(0), exit(1), exit(2)}};
    for (int axis = 0; !is_even_ && axis < 3; ++axis) {
      if (!planes_[axis]) continue;
      const double side = high[axis] - low[axis];
      if (!(in[axis] >= t0)) span.u0[axis] /= side;
      if (!(t1 >= out[axis])) span.u1[axis] /= side;
    }
    return span;
  }

 private:
  double place_of(std::size_t axis, int plane) const {
    return planes_[axis] ? planes_[axis][plane] : plane;
  }
  // Returns the middle of the layer of voxels that holds the origin: of the last one if it lies on
  // the far side, of one beyond if it lies outside.
  double middle_of_layer(std::size_t axis) const {
    const int last = voxels_[axis];
    const double top = place_of(axis, last), bottom = place_of(axis, 0);
    if (!planes_[axis]) {
      const double o = std::clamp(origin_[axis], -1.0, top + 1);
      return (o == top ? top - 1 : std::floor(o)) + 0.5;
    }
    if (origin_[axis] < bottom || origin_[axis] > top) return origin_[axis];
    const int n = gap_at(planes_[axis], last + 1, origin_[axis]);
    return 0.5 * (place_of(axis, n) + place_of(axis, n + 1));
  }
  void set_sides() {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      entry_side_[axis] = 1 - ahead_[axis];
      exit_side_[axis] = ahead_[axis];
    }
  }

  std::array<int, 3> voxels_, ahead_{};
  Planes planes_;
  bool is_even_;
  std::array<double, 3> origin_, direction_, inverse_{};
  // Local coordinates of a voxel's planes where the line enters and leaves: 0 or 1.
  std::array<double, 3> entry_side_{}, exit_side_{};
  std::array<double, 3> base_;  // plane numbers count from it: origin_, unless parallel
  bool valid_ = false;
};

// From the scaled frame to the units of lines.
class VoxelUnits {
 public:
  // Keeps pointers to the volume's places.
  explicit VoxelUnits(const Volume& volume)
      : is_even_(volume.is_even()),
        per_spacing_(divided({1, 1, 1}, volume.spacing())),
        first_(to_vec3(volume.first())),
        top_(to_vec3(volume.voxels())),
        planes_{volume.places(0), volume.places(1), volume.places(2)},
        voxels_(volume.voxels()),
        box_(volume.box()) {
    for (int axis = 0; axis < 3; ++axis) {
      if (planes_[axis]) per_spacing_[axis] = 1;
    }
  }

  // Returns a point (scaled frame) in the units of lines. If it is in the volume's box it is also
  // in the box of voxels, whatever the spacing's rounding.
  Vec3 point(const Vec3& p) const {
    const auto in_voxels = [&](int axis) {
      const double u = p[axis] * per_spacing_[axis] - first_[axis];
      const double below = p[axis] <= box_.hi[axis] ? smaller(u, top_[axis]) : u;
      return p[axis] >= box_.lo[axis] ? greater(below, 0.0) : below;
    };
    Vec3 at{in_voxels(0), in_voxels(1), in_voxels(2)};
    for (int axis = 0; axis < 3 && !is_even_; ++axis) {
      if (planes_[axis]) at[axis] = p[axis];
    }
    return at;
  }

  // A point in its voxel, that of the box nearest to it.
  struct Local {
    Index3 voxel;
    Vec3 u;         // in [0, 1] along each axis if it is in the voxel
    Vec3 per_side;  // one over the sides of the voxel (scaled frame)
  };
  Local local(const Vec3& p) const {
    Local at{{}, point(p), per_spacing_};
    for (int axis = 0; axis < 3; ++axis) {
      at.voxel[axis] = static_cast<int>(greater(smaller(at.u[axis], top_[axis] - 1), 0.0));
    }
    at.u = at.u - to_vec3(at.voxel);
    if (!is_even_) put_between_planes(p, at);
    return at;
  }

  // Returns the line origin + t * direction (scaled frame) in its units, with the same t.
  LatticeLine line(const Vec3& origin, const Vec3& direction) const {
    return {point(origin), times(direction, per_spacing_), voxels_, planes_};
  }
  VoxelBox box() const { return {{0, 0, 0}, {voxels_.i, voxels_.j, voxels_.k}}; }

 private:
  void put_between_planes(const Vec3& p, Local& at) const {
    for (int axis = 0; axis < 3; ++axis) {
      const double* places = planes_[axis];
      if (!places) continue;
      const int n = at.voxel[axis] = gap_at(places, voxels_[axis] + 1, p[axis]);
      const double side = places[n + 1] - places[n];
      at.u[axis] = (p[axis] - places[n]) / side;
      at.per_side[axis] = 1 / side;
    }
  }

  bool is_even_;
  Vec3 per_spacing_, first_, top_;  // per_spacing_: 1 along an axis of uneven steps
  Planes planes_;
  Index3 voxels_;
  Box3 box_;
};

// Steps through the voxels along a line, in order. The line must outlive the walk. Usage:
//   for (VoxelWalk walk(line, voxel, range); !walk.done(); walk.step()) ... walk.voxel() ...
class VoxelWalk {
 public:
  // pre: the range lies in the box of all voxels, and `voxel` holds the line just after range.lo.
  VoxelWalk(const LatticeLine& line, Index3 voxel, Range range)
      : line_(line), voxel_{voxel.i, voxel.j, voxel.k}, t_(range.lo), end_(range.hi) {
    for (std::size_t axis = 0; axis < 3; ++axis) leave_[axis] = line.leave(axis, voxel_[axis]);
    find_next();
  }

  bool done() const { return !(t_ < end_); }
  Index3 voxel() const { return {voxel_[0], voxel_[1], voxel_[2]}; }
  double t() const { return t_; }
  double end() const { return end_; }
  VoxelSpan span() const { return line_.span(voxel(), {t_, end_}); }

  void step() {
    t_ = leave_[next_];
    // A line through an edge or a corner crosses two or three planes at once. Far from its origin,
    // several planes may round to one parameter.
    while (t_ < end_ && leave_[next_] <= t_) {
      voxel_[next_] += 2 * line_.ahead(next_) - 1;
      leave_[next_] = line_.leave(next_, voxel_[next_]);
      find_next();
    }
  }

 private:
  void find_next() {
    const std::size_t first = leave_[1] < leave_[0];
    next_ = leave_[2] < leave_[first] ? 2 : first;
  }

  const LatticeLine& line_;
  std::array<int, 3> voxel_;
  std::array<double, 3> leave_;
  std::size_t next_ = 0;  // the axis whose plane comes next
  double t_, end_;
};

}  // namespace deliso
