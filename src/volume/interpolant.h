// SPDX-License-Identifier: MIT
// The trilinear interpolant less kappa, for many evaluations at places near each other: no division
// and no choice by the sample type in each. Signs may differ from those of Volume::value() within
// rounding.
#pragma once

#include "volume/volume.h"

namespace deliso {

class Interpolant {
 public:
  // Keeps a pointer to the samples.
  Interpolant(const Volume& volume, double kappa)
      : kappa_(kappa),
        per_spacing_{1 / volume.spacing().x, 1 / volume.spacing().y, 1 / volume.spacing().z},
        first_(to_vec3(volume.first())),
        end_(to_vec3(volume.voxels())),
        last_(volume.voxels() + Index3{-1, -1, -1}),
        dy_(volume.dims().i),
        dz_(dy_ * volume.dims().j) {
    volume.visit([&]<class Sample>(const Sample* samples) {
      samples_ = samples;
      value_ = &value<Sample>;
    });
  }

  // Returns g(p) - kappa. Points outside the box are clamped to it.
  double operator()(const Vec3& p) const { return value_(*this, p); }

 private:
  template <class Sample>
  static double value(const Interpolant& g, const Vec3& p) {
    Vec3 u;
    Index3 at;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = p[axis] * g.per_spacing_[axis] - g.first_[axis];
      u[axis] = x < 0 ? 0 : x > g.end_[axis] ? g.end_[axis] : x;
      at[axis] = static_cast<int>(u[axis]);
      at[axis] = at[axis] > g.last_[axis] ? g.last_[axis] : at[axis];
      u[axis] -= at[axis];
    }
    const std::size_t n = at.i + g.dy_ * at.j + g.dz_ * at.k;
    const Corners c = corners_from(static_cast<const Sample*>(g.samples_) + n, g.dy_, g.dz_, 0);
    const double c00 = c[0] + u.x * (c[1] - c[0]), c10 = c[2] + u.x * (c[3] - c[2]);
    const double c01 = c[4] + u.x * (c[5] - c[4]), c11 = c[6] + u.x * (c[7] - c[6]);
    const double c0 = c00 + u.y * (c10 - c00), c1 = c01 + u.y * (c11 - c01);
    return c0 + u.z * (c1 - c0) - g.kappa_;
  }

  double kappa_;
  Vec3 per_spacing_, first_, end_;
  Index3 last_;
  std::size_t dy_, dz_;
  const void* samples_ = nullptr;
  double (*value_)(const Interpolant&, const Vec3&) = nullptr;
};

}  // namespace deliso
