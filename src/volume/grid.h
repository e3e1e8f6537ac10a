// SPDX-License-Identifier: MIT
// The grid of a volume's samples: their number, type and places, without the samples.
//
// Frame: sample (i,j,k) lies at (i*sx, j*sy, k*sz). All geometry is in this scaled frame. The
// grid's Frame gives its place in the world; a mesh keeps it.
// Along an axis samples may lie at places of their own, as the slices of a scan do that is coarser
// from some place on (a rectilinear grid). Within a voxel nothing changes by that. So the
// interpolant has the topology of these samples, whatever their distances.
// A voxel is the box between eight neighboring samples. Corner m of voxel (i,j,k) is the sample
// (i + (m&1), j + (m>>1&1), k + (m>>2)).
//
// A grid may be a block of a larger one, which is meshed block by block. A block counts samples
// from its own first one, but places them as the larger grid does, to the last bit. So two blocks
// compute the same from the samples that they share.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "base/box3.h"
#include "base/frame.h"
#include "base/sample_type.h"
#include "base/vec3.h"

namespace deliso {

struct Index3 {
  int i = 0, j = 0, k = 0;
  constexpr int operator[](int axis) const { return axis == 0 ? i : axis == 1 ? j : k; }
  constexpr int& operator[](int axis) { return axis == 0 ? i : axis == 1 ? j : k; }
  friend constexpr Index3 operator+(Index3 a, Index3 b) {
    return {a.i + b.i, a.j + b.j, a.k + b.k};
  }
  friend bool operator==(const Index3&, const Index3&) = default;
};

constexpr Vec3 to_vec3(Index3 n) {
  return {static_cast<double>(n.i), static_cast<double>(n.j), static_cast<double>(n.k)};
}

// Returns the sample at corner m of a voxel; the corner is at the high end of axis k if bit k of m
// is set.
constexpr Index3 corner_of(Index3 voxel, int m) {
  return voxel + Index3{m & 1, m >> 1 & 1, m >> 2};
}

// Calls visit(at) for all places from `lo` to `hi`, both included along each axis; x goes fastest.
template <class Visit>
void for_each_place(Index3 lo, Index3 hi, Visit&& visit) {
  Index3 at;
  for (at.k = lo.k; at.k <= hi.k; ++at.k) {
    for (at.j = lo.j; at.j <= hi.j; ++at.j) {
      for (at.i = lo.i; at.i <= hi.i; ++at.i) visit(at);
    }
  }
}

// Returns the voxel's number in scan order; `dims` are the volume's, in samples.
constexpr std::uint64_t voxel_number(Index3 dims, Index3 voxel) {
  return voxel.i + std::uint64_t(dims.i - 1) * (voxel.j + std::uint64_t(dims.j - 1) * voxel.k);
}

// Returns the voxel with that number.
constexpr Index3 numbered_voxel(Index3 dims, std::uint64_t number) {
  const std::uint64_t nx = dims.i - 1, ny = dims.j - 1;
  return {static_cast<int>(number % nx), static_cast<int>(number / nx % ny),
          static_cast<int>(number / nx / ny)};
}

// Returns the faces of a grid's box on which `at` lies: bit f for face f. `count`: places along
// each axis.
constexpr unsigned outer_faces(Index3 at, Index3 count) {
  const auto ends = [](int n, int of) { return unsigned(n == 0) | unsigned(n == of - 1) << 1; };
  return ends(at.i, count.i) | ends(at.j, count.j) << 2 | ends(at.k, count.k) << 4;
}

// Returns the voxel across face f of `voxel`; it may lie outside the volume.
inline Index3 voxel_across(Index3 voxel, int f) {
  voxel[f >> 1] += (f & 1) != 0 ? 1 : -1;
  return voxel;
}

// Throws InputError, with the volume's `name`, if a dimension is below 1, a length is out of range
// (base/frame.h), or an axis is no unit vector.
void require_in_range(Index3 dims, const Vec3& spacing, const Frame& frame, std::string_view name);

// The places of samples along each axis, increasing from 0; none along an axis of even steps.
using Coordinates = std::array<std::vector<double>, 3>;

// Returns the median of their distances, of two the smaller one. pre: two or more.
double median_gap(const std::vector<double>& places);

class Grid {
 public:
  // Throws as require_in_range does. Fewer than two samples along an axis make no voxel.
  Grid(Index3 dims, const Vec3& spacing, SampleType type, const Frame& frame = {})
      : dims_(dims),
        spacing_(spacing),
        least_spacing_(spacing),
        type_(type),
        frame_(frame),
        whole_(dims) {
    require_in_range(dims, spacing, frame, "volume");
  }

  // Returns the grid of samples of another type.
  Grid of_type(SampleType type) const {
    Grid other = *this;
    other.type_ = type;
    return other;
  }
  // Returns the same grid elsewhere in the world.
  Grid with_frame(const Frame& frame) const {
    Grid other = *this;
    other.frame_ = frame;
    return other;
  }
  // Returns the same grid with its samples at these places, as many as it has along an axis; its
  // spacing is that of a usual voxel (median_gap). Throws InputError, with the volume's `name`, if
  // they do not increase, or are out of range. pre: this is no block.
  Grid with_places(Coordinates places, std::string_view name) const;
  // Returns a block of the larger grid, from its sample `first` on.
  Grid part(Index3 first, Index3 dims) const {
    Grid part = *this;
    part.first_ = first;
    part.dims_ = dims;
    return part;
  }
  // Returns these samples of it as a grid of their own, which begins with the first of them. A
  // usual voxel stays that of the whole.
  Grid cropped(Index3 first, Index3 dims) const;
  // Returns the larger grid; of what is no block, the grid itself.
  Grid whole() const { return part({}, whole_); }

  Index3 dims() const { return dims_; }
  Index3 voxels() const { return {dims_.i - 1, dims_.j - 1, dims_.k - 1}; }
  // Between samples; of uneven ones the usual distance, and the least.
  Vec3 spacing() const { return spacing_; }
  Vec3 least_spacing() const { return least_spacing_; }
  // Returns the side of the cube with a usual voxel's volume: the unit of lengths in voxels.
  double voxel() const;
  // Returns that of a cube as small as any voxel: the unit of what must be apart in all of them.
  double least_voxel() const;
  SampleType type() const { return type_; }
  const Frame& frame() const { return frame_; }
  // The first sample's index in the larger grid, and that grid's size; 0 and dims() without one.
  Index3 first() const { return first_; }
  Index3 whole_dims() const { return whole_; }
  bool is_block() const { return dims_ != whole_; }
  // Returns the faces of the box that are inside the larger grid, and so shared with another block:
  // bit f for face f (2 * axis, + 1 at the high end).
  unsigned inner_faces() const;
  std::size_t sample_count() const { return std::size_t(dims_.i) * dims_.j * dims_.k; }
  std::size_t index(int i, int j, int k) const {
    return i + std::size_t(dims_.i) * (j + std::size_t(dims_.j) * k);
  }

  bool is_even() const { return places_ == nullptr; }
  // Returns the places of the block's samples along an axis; null if the steps are even.
  const double* places(int axis) const {
    return places_ && !(*places_)[axis].empty() ? &(*places_)[axis][first_[axis]] : nullptr;
  }
  // The places of the larger grid, empty where even.
  Coordinates all_places() const { return places_ ? *places_ : Coordinates(); }

  // Returns the box of all samples: [0, (n-1)*s] along each axis if this is no block and even.
  Box3 box() const;
  // Returns the box of the places that are not on its faces, and by rounding do not come there on
  // their way to the world and back.
  Box3 within() const;
  Vec3 position(Index3 sample) const {
    return places_ ? at_samples(to_vec3(first_ + sample))
                   : times(to_vec3(first_ + sample), spacing_);
  }
  // Returns the distances between the samples of a voxel.
  Vec3 sides(Index3 voxel) const {
    return places_ ? position(corner_of(voxel, 7)) - position(voxel) : spacing_;
  }
  // Returns a voxel's volume, and the length along an axis that is nearer to samples begin to end-1
  // than to others, both in those of a usual voxel.
  double share_of(Index3 voxel) const {
    const Vec3 s = sides(voxel);
    return places_ ? s.x * s.y * s.z / (spacing_.x * spacing_.y * spacing_.z) : 1;
  }
  double share_of(int axis, int begin, int end) const;
  // Return a coordinate in samples along an axis, counted from the block's first one. Beyond the
  // block the steps are those of its last voxel.
  double in_samples(const Vec3& p, int axis) const {
    return in_all_samples(p, axis) - first_[axis];
  }
  // The same, counted from the larger grid's first sample, and back. Exact at samples; between two
  // samples both are in between.
  double in_all_samples(const Vec3& p, int axis) const {
    const double* at = places(axis);
    return at ? between_places(at, p[axis], axis) : p[axis] / spacing_[axis];
  }
  Vec3 in_all_samples(const Vec3& p) const {
    return places_ ? Vec3{in_all_samples(p, 0), in_all_samples(p, 1), in_all_samples(p, 2)}
                   : divided(p, spacing_);
  }
  double at_samples(double u, int axis) const {
    const double* at = places(axis);
    return at ? at_between_places(at, u, axis) : u * spacing_[axis];
  }
  Vec3 at_samples(const Vec3& u) const {
    return places_ ? Vec3{at_samples(u.x, 0), at_samples(u.y, 1), at_samples(u.z, 2)}
                   : times(u, spacing_);
  }
  // True if a coordinate is that of a sample.
  bool is_on_plane(const Vec3& p, int axis) const;
  bool has_voxel(Index3 voxel) const {
    const auto holds = [](int n, int of) { return 0 <= n && n < of - 1; };
    return holds(voxel.i, dims_.i) && holds(voxel.j, dims_.j) && holds(voxel.k, dims_.k);
  }
  // Returns the voxel that holds p, clamped to the box.
  Index3 voxel_at(const Vec3& p) const;

 private:
  double between_places(const double* at, double x, int axis) const;
  double at_between_places(const double* at, double u, int axis) const;

  Index3 dims_;
  Vec3 spacing_, least_spacing_;
  SampleType type_;
  Frame frame_;
  Index3 first_, whole_;
  std::shared_ptr<const Coordinates> places_{};  // of the larger grid; null if all steps are even
};

// Returns the index, from 0 to n - 2, of the gap between increasing places that holds x, its lower
// end included; beyond all places the first or the last one. pre: n >= 2.
inline int gap_at(const double* places, int n, double x) {
  return static_cast<int>(std::upper_bound(places + 1, places + n - 1, x) - (places + 1));
}

}  // namespace deliso
