// SPDX-License-Identifier: MIT
// A scalar volume: samples on a regular grid, kept in their own type, and their trilinear
// interpolant g (paper §2).
//
// Frame: sample (i,j,k) lies at (i*sx, j*sy, k*sz). All geometry is in this scaled frame. The
// volume's Frame gives its place in the world; a mesh keeps it.
// Layout: x fastest, native byte order, aligned for the type, owned or memory-mapped.
// A voxel is the box between eight neighboring samples. Corner m of voxel (i,j,k) is the sample
// (i + (m&1), j + (m>>1&1), k + (m>>2)).
//
// A volume may be a block of a larger one, which is meshed block by block. A block counts samples
// from its own first one, but places them as the larger volume does, to the last bit. So two blocks
// compute the same from the samples that they share.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/box3.h"
#include "base/check.h"
#include "base/frame.h"
#include "base/sample_type.h"
#include "base/text.h"
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

// The eight values at a voxel's corners.
using Corners = std::array<double, 8>;

// Returns the corner values, less kappa, of the voxel whose first sample is *s. dy and dz are the
// steps to the next sample in y and in z.
template <class T>
Corners corners_from(const T* s, std::size_t dy, std::size_t dz, double kappa) {
  return {static_cast<double>(s[0]) - kappa,       static_cast<double>(s[1]) - kappa,
          static_cast<double>(s[dy]) - kappa,      static_cast<double>(s[dy + 1]) - kappa,
          static_cast<double>(s[dz]) - kappa,      static_cast<double>(s[dz + 1]) - kappa,
          static_cast<double>(s[dz + dy]) - kappa, static_cast<double>(s[dz + dy + 1]) - kappa};
}

// Returns the trilinear interpolant of corner values at a point of the voxel, [0, 1] along each
// axis.
constexpr double interpolated(const Corners& c, double x, double y, double z) {
  const double c00 = c[0] + x * (c[1] - c[0]), c10 = c[2] + x * (c[3] - c[2]);
  const double c01 = c[4] + x * (c[5] - c[4]), c11 = c[6] + x * (c[7] - c[6]);
  const double c0 = c00 + y * (c10 - c00), c1 = c01 + y * (c11 - c01);
  return c0 + z * (c1 - c0);
}

// True if the voxel whose first corner is *s is active. dy and dz are the steps to the next sample
// in y and in z.
template <class T>
bool is_active_voxel(const T* s, std::size_t dy, std::size_t dz, T threshold) {
  const int inside = (s[0] >= threshold) + (s[1] >= threshold) + (s[dy] >= threshold) +
                     (s[dy + 1] >= threshold) + (s[dz] >= threshold) + (s[dz + 1] >= threshold) +
                     (s[dz + dy] >= threshold) + (s[dz + dy + 1] >= threshold);
  return inside != 0 && inside != 8;
}

// Throws InputError, with the volume's `name`, if a dimension is below 1, a length is out of range
// (base/frame.h), or an axis is no unit vector.
void require_in_range(Index3 dims, const Vec3& spacing, const Frame& frame, std::string_view name);

class Volume {
 public:
  // `bytes` holds dims.i * dims.j * dims.k samples; `owner` keeps them alive (a vector, a mapping).
  // Throws as require_in_range does. Fewer than two samples along an axis make no voxel.
  Volume(Index3 dims, Vec3 spacing, SampleType type, const std::byte* bytes,
         std::shared_ptr<const void> owner, Frame frame = {});

  // Returns a volume that has no samples: what is known of one that is read elsewhere.
  static Volume without_samples(Index3 dims, const Vec3& spacing, SampleType type,
                                const Frame& frame) {
    return Volume(dims, spacing, type, nullptr, nullptr, frame);
  }

  // Returns other samples in the place of these: as many, of any type.
  Volume with_samples(SampleType type, const std::byte* bytes,
                      std::shared_ptr<const void> owner) const;

  // Returns the same samples elsewhere in the world.
  Volume with_frame(const Frame& frame) const {
    Volume other = *this;
    other.frame_ = frame;
    return other;
  }

  // Returns this volume as a block of a larger one: samples `first` and following of `whole`.
  // pre: it fits into `whole`, and frame() is that of the larger volume.
  Volume as_block(Index3 first, Index3 whole) const;

  // Samples f(p) as float64 at dims.i * dims.j * dims.k points p of a box in the world, its corners
  // included. Throws InputError if the box is empty or out of range, or has no voxel.
  template <class F>
  static Volume from_function(const Box3& box, Index3 dims, F&& f);

  // Copies `samples`. Throws InputError unless there are dims.i * dims.j * dims.k of them.
  template <class T>
  static Volume from_samples(Index3 dims, Vec3 spacing, const std::vector<T>& samples,
                             Frame frame = {});

  Index3 dims() const { return dims_; }
  Index3 voxels() const { return {dims_.i - 1, dims_.j - 1, dims_.k - 1}; }
  Vec3 spacing() const { return spacing_; }
  // Returns the side of the cube with a voxel's volume: the unit of lengths in voxels.
  double voxel() const;
  SampleType type() const { return type_; }
  const Frame& frame() const { return frame_; }
  // The first sample's index in the larger volume, and that volume's size; 0 and dims() without
  // one.
  Index3 first() const { return first_; }
  Index3 whole_dims() const { return whole_; }
  bool is_block() const { return dims_ != whole_; }
  // Returns the faces of the box that are inside the larger volume, and so shared with another
  // block: bit f for face f (2 * axis, + 1 at the high end).
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
  // Returns the voxel that holds p, clamped to the box.
  Index3 voxel_at(const Vec3& p) const;

  // Calls f with a pointer to the samples in their own type, so that inner loops are monomorphic.
  template <class F>
  decltype(auto) visit(F&& f) const {
    return with_type(
        type_, [&]<class T>(T) -> decltype(auto) { return f(reinterpret_cast<const T*>(bytes_)); });
  }

  double sample(int i, int j, int k) const {
    const std::size_t n = index(i, j, k);
    return visit([n](const auto* s) { return static_cast<double>(s[n]); });
  }
  // Returns the values at a voxel's corners, less kappa.
  Corners corners(Index3 voxel, double kappa = 0) const;

  // The trilinear interpolant and its gradient, per unit of the scaled frame. g is only C0 across
  // voxels, so the gradient is that of voxel_at(p). Points outside the box are clamped to it.
  double value(const Vec3& p) const;
  Vec3 gradient(const Vec3& p) const;

 private:
  Index3 dims_;
  Vec3 spacing_;
  SampleType type_;
  const std::byte* bytes_;
  std::shared_ptr<const void> owner_;
  Frame frame_;
  Index3 first_, whole_;
};

// The smallest and the largest sample.
struct ValueRange {
  double min = 0, max = 0;
};
// Returns the range of all samples. Throws InputError for a NaN or infinite sample, with the
// volume's `name` and the first such sample's index.
ValueRange value_range(const Volume& volume, std::string_view name = "volume");

// Returns the smallest sample value that is inside; nothing if the type has none.
template <class T>
std::optional<T> inside_threshold(double kappa) {
  using Limits = std::numeric_limits<T>;
  if (!(kappa <= static_cast<double>(Limits::max()))) return std::nullopt;
  if (kappa <= static_cast<double>(Limits::lowest())) return Limits::lowest();
  if constexpr (std::is_integral_v<T>) {
    return static_cast<T>(std::ceil(kappa));
  } else {
    const T rounded = static_cast<T>(kappa);
    return static_cast<double>(rounded) < kappa ? std::nextafter(rounded, Limits::max()) : rounded;
  }
}

// Returns the kappa that the geometry uses; inside is f >= kappa. Where samples or saddles equal
// kappa, the surface would touch itself there, and just below come as near as that. So kappa is put
// where the surface is robust. It depends on the type and the isovalue alone, so all blocks of a
// volume have the same, and so does a check. No number of the type lies between the two, so each
// sample stays on its side:
//   - integers of n bits: less by .38 if the isovalue is an integer. A multiple of 2^-n, which only
//     saddles may equal, is lowered by .001, or by half the way to the next lower integer if that
//     is shorter. Any other isovalue stays: no sample equals it, and no saddle of a face. A saddle
//     is a fraction of two integers, and the lower one is below 2^(n+1).
//   - float32: halfway to the next lower float if the isovalue is a float, else the isovalue.
//   - float64: the isovalue. A sample or a saddle may equal it; crossings stay off samples all the
//     same (contour/piece_mesher.h).
// For floats there is no better rule: any lower kappa has numbers of the type between it and the
// isovalue, and samples there would change their side.
double geometric_isovalue(SampleType type, double isovalue);

template <class T>
Volume Volume::from_samples(Index3 dims, Vec3 spacing, const std::vector<T>& samples, Frame frame) {
  auto owner = std::make_shared<const std::vector<T>>(samples);
  Volume volume(dims, spacing, sample_type_of<T>(),
                reinterpret_cast<const std::byte*>(owner->data()), owner, frame);
  if (samples.size() != volume.sample_count()) {
    throw InputError("a volume of ", dims.i, " x ", dims.j, " x ", dims.k, " samples is given ",
                     samples.size());
  }
  return volume;
}

template <class F>
Volume Volume::from_function(const Box3& box, Index3 dims, F&& f) {
  Vec3 step;
  for (int axis = 0; axis < 3; ++axis) {
    if (dims[axis] < 2) throw InputError("a function is sampled twice or more along each axis");
    step[axis] = (box.hi[axis] - box.lo[axis]) / (dims[axis] - 1);
  }
  require_in_range(dims, step, {.origin = box.lo}, "the box of a function");
  std::vector<double> samples;
  for (int k = 0; k < dims.k; ++k) {
    for (int j = 0; j < dims.j; ++j) {
      for (int i = 0; i < dims.i; ++i) {
        samples.push_back(f(box.lo + Vec3{i * step.x, j * step.y, k * step.z}));
      }
    }
  }
  return from_samples(dims, step, samples, {.origin = box.lo});
}

}  // namespace deliso
