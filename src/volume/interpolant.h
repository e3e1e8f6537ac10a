// SPDX-License-Identifier: MIT
// The trilinear interpolant less kappa, at four points of a line: no division and no choice by the
// sample type at each, and the compiler computes places side by side. Signs may differ from those
// of Volume::value() within rounding.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "volume/volume.h"

namespace deliso {

class Interpolant {
 public:
  using Four = std::array<double, 4>;

  // Keeps a reference to the volume, and a pointer to its samples.
  Interpolant(const Volume& volume, double kappa)
      : kappa_(kappa), grid_(volume), dy_(volume.dims().i), dz_(dy_ * volume.dims().j) {
    for (int axis = 0; axis < 3; ++axis) {
      per_spacing_[axis] = 1 / volume.spacing()[axis];
      lo_[axis] = volume.first()[axis];
      hi_[axis] = std::nextafter(lo_[axis] + volume.voxels()[axis], lo_[axis]);
    }
    volume.visit([&]<class Sample>(const Sample* samples) {
      samples_ = samples;
      on_line_ = &on_line<Sample, true>;
      if (!volume.is_even()) on_line_ = &on_line<Sample, false>;
    });
  }

  // Returns g - kappa at the points from + t * along. Points outside the box are clamped to it.
  Four on_line(const Vec3& from, const Vec3& along, const Four& t) const {
    return on_line_(*this, from, along, t);
  }

 private:
  template <class Sample, bool is_even>
  static Four on_line(const Interpolant& g, const Vec3& from, const Vec3& along, const Four& t) {
    std::array<std::array<int, 4>, 3> voxel;
    std::array<Four, 3> place;  // in the voxel
    const auto locate = [&](int axis) {
      const double start = from[axis], direction = along[axis], scale = g.per_spacing_[axis];
      const double lo = g.lo_[axis], hi = g.hi_[axis];
      for (int n = 0; n < 4; ++n) {
        // A place that is not a number becomes lo.
        const double at = is_even ? (start + t[n] * direction) * scale
                                  : g.grid_.in_all_samples(from + t[n] * along, axis);
        const double x = std::min(std::max(lo, at), hi) - lo;
        voxel[axis][n] = static_cast<int>(x);
        place[axis][n] = x - voxel[axis][n];
      }
    };
    locate(0), locate(1), locate(2);
    Four values;
    for (int n = 0; n < 4; ++n) {
      const std::size_t first = voxel[0][n] + g.dy_ * voxel[1][n] + g.dz_ * voxel[2][n];
      const Corners c =
          corners_from(static_cast<const Sample*>(g.samples_) + first, g.dy_, g.dz_, 0);
      values[n] = interpolated(c, place[0][n], place[1][n], place[2][n]) - g.kappa_;
    }
    return values;
  }

  double kappa_;
  const Grid& grid_;
  Vec3 per_spacing_, lo_, hi_;  // lo_, hi_: of the box, in voxels; hi_ lies in the last voxel
  std::size_t dy_, dz_;
  const void* samples_ = nullptr;
  Four (*on_line_)(const Interpolant&, const Vec3&, const Vec3&, const Four&) = nullptr;
};

}  // namespace deliso
