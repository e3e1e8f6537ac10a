// SPDX-License-Identifier: MIT
// The regular grid of a volume's samples: their number, type and places, without the samples.
//
// Frame: sample (i,j,k) lies at (i*sx, j*sy, k*sz). All geometry is in this scaled frame. The
// grid's Frame gives its place in the world; a mesh keeps it.
// A voxel is the box between eight neighboring samples. Corner m of voxel (i,j,k) is the sample
// (i + (m&1), j + (m>>1&1), k + (m>>2)).
//
// A grid may be a block of a larger one, which is meshed block by block. A block counts samples
// from its own first one, but places them as the larger grid does, to the last bit. So two blocks
// compute the same from the samples that they share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

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

class Grid {
 public:
  // Throws as require_in_range does. Fewer than two samples along an axis make no voxel.
  Grid(Index3 dims, const Vec3& spacing, SampleType type, const Frame& frame = {})
      : dims_(dims), spacing_(spacing), type_(type), frame_(frame), whole_(dims) {
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
  // Returns this grid as a block of a larger one: samples `first` and following of `whole`.
  // pre: it fits into `whole`, and frame() is that of the larger grid.
  Grid as_block(Index3 first, Index3 whole) const;
  // Returns the larger grid; of what is no block, the grid itself.
  Grid whole() const { return {whole_, spacing_, type_, frame_}; }

  Index3 dims() const { return dims_; }
  Index3 voxels() const { return {dims_.i - 1, dims_.j - 1, dims_.k - 1}; }
  Vec3 spacing() const { return spacing_; }
  // Returns the side of the cube with a voxel's volume: the unit of lengths in voxels.
  double voxel() const;
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

  // Returns the box of all samples: [0, (n-1)*s] along each axis if this is no block.
  Box3 box() const;
  Vec3 position(Index3 sample) const { return times(to_vec3(first_ + sample), spacing_); }
  // Returns a coordinate in samples along an axis, counted from the block's first one.
  double in_samples(const Vec3& p, int axis) const {
    return p[axis] / spacing_[axis] - first_[axis];
  }
  bool has_voxel(Index3 voxel) const {
    const auto holds = [](int n, int of) { return 0 <= n && n < of - 1; };
    return holds(voxel.i, dims_.i) && holds(voxel.j, dims_.j) && holds(voxel.k, dims_.k);
  }
  // Returns the voxel that holds p, clamped to the box.
  Index3 voxel_at(const Vec3& p) const;

 private:
  Index3 dims_;
  Vec3 spacing_;
  SampleType type_;
  Frame frame_;
  Index3 first_, whole_;
};

}  // namespace deliso
