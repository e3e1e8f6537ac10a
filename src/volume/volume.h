// SPDX-License-Identifier: MIT
// A scalar volume: samples on a grid (volume/grid.h), kept in their own type, and their
// trilinear interpolant g (paper §2).
//
// Layout: x fastest, native byte order, aligned for the type, owned or memory-mapped.
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
#include <utility>
#include <vector>

#include "base/box3.h"
#include "base/check.h"
#include "base/frame.h"
#include "base/sample_type.h"
#include "base/vec3.h"
#include "volume/grid.h"

namespace deliso {

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

// A grid and its samples. What has none is a Grid, so it has no value, no gradient.
class Volume : public Grid {
 public:
  // `bytes` holds sample_count() samples; `owner` keeps them alive (a vector, a mapping).
  Volume(const Grid& grid, const std::byte* bytes, std::shared_ptr<const void> owner);
  // The same with the grid of these dimensions. Throws as Grid does.
  Volume(Index3 dims, const Vec3& spacing, SampleType type, const std::byte* bytes,
         std::shared_ptr<const void> owner, const Frame& frame = {})
      : Volume(Grid(dims, spacing, type, frame), bytes, std::move(owner)) {}

  // Returns other samples in the place of these: as many, of any type.
  Volume with_samples(SampleType type, const std::byte* bytes,
                      std::shared_ptr<const void> owner) const {
    return {of_type(type), bytes, std::move(owner)};
  }
  // Return the same samples elsewhere in the world, and at other places.
  Volume with_frame(const Frame& frame) const { return {Grid::with_frame(frame), bytes_, owner_}; }
  Volume with_places(Coordinates places, std::string_view name) const {
    return {Grid::with_places(std::move(places), name), bytes_, owner_};
  }

  // Samples f(p) as float64 at dims.i * dims.j * dims.k points p of a box in the world, its corners
  // included. Throws InputError if the box is empty or out of range, or has no voxel.
  template <class F>
  static Volume from_function(const Box3& box, Index3 dims, F&& f);

  // Copies `samples`. Throws InputError unless there are dims.i * dims.j * dims.k of them.
  template <class T>
  static Volume from_samples(Index3 dims, Vec3 spacing, const std::vector<T>& samples,
                             Frame frame = {}) {
    return from_samples(Grid(dims, spacing, sample_type_of<T>(), frame), samples);
  }
  // The same at the places of a grid, of whatever type.
  template <class T>
  static Volume from_samples(const Grid& grid, const std::vector<T>& samples);

  // Calls f with a pointer to the samples in their own type, so that inner loops are monomorphic.
  template <class F>
  decltype(auto) visit(F&& f) const {
    return with_type(type(), [&]<class T>(T) -> decltype(auto) {
      return f(reinterpret_cast<const T*>(bytes_));
    });
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
  const std::byte* bytes_;
  std::shared_ptr<const void> owner_;
};

// The smallest and the largest sample.
struct ValueRange {
  double min = 0, max = 0;
};
// Bound on the magnitude of samples. Products of four of their differences, as in the discriminants
// of saddles (contour/exact_sign.h), stay finite. No float32 is larger.
inline constexpr double kLargestSample = 1e75;
// Returns the range of all samples. Throws InputError for a sample that is NaN, infinite or beyond
// kLargestSample, with the volume's `name` and the first such sample's index. Samples and isovalue
// times a power of two have the same mesh, up to this bound.
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
//     saddles may equal, is lowered by 2^-20, or by half the way to the next lower integer if that
//     is shorter. Any other isovalue stays: no sample equals it, and no saddle of a face. A saddle
//     is a fraction of two integers, and the lower one is below 2^(n+1).
//   - float32: halfway to the next lower float if the isovalue is a float, else the isovalue.
//   - float64: the isovalue. A sample or a saddle may equal it; crossings stay off samples all the
//     same (contour/piece_mesher.h).
// For floats there is no better rule: any lower kappa has numbers of the type between it and the
// isovalue, and samples there would change their side.
double geometric_isovalue(SampleType type, double isovalue);

template <class T>
Volume Volume::from_samples(const Grid& grid, const std::vector<T>& samples) {
  const Index3 dims = grid.dims();
  if (samples.size() != grid.sample_count()) {
    throw InputError("a volume of ", dims.i, " x ", dims.j, " x ", dims.k, " samples is given ",
                     samples.size());
  }
  const auto owner = std::make_shared<const std::vector<T>>(samples);
  return {grid.of_type(sample_type_of<T>()), reinterpret_cast<const std::byte*>(owner->data()),
          owner};
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
  for_each_place({}, dims + Index3{-1, -1, -1},
                 [&](Index3 at) { samples.push_back(f(box.lo + times(to_vec3(at), step))); });
  return from_samples(dims, step, samples, {.origin = box.lo});
}

}  // namespace deliso
