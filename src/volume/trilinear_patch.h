// SPDX-License-Identifier: MIT
// The trilinear polynomial of a voxel: value = sum of coefficients times 1, x, y, xy, z, xz, yz,
// xyz, in the order of the corners. Coordinates are the voxel's own, [0, 1] along each axis.
#pragma once

#include <array>

#include "base/vec3.h"
#include "volume/volume.h"

namespace deliso {

class TrilinearPatch {
 public:
  explicit TrilinearPatch(const Corners& c)  // values minus kappa
      : k_{c[0], c[1] - c[0], c[2] - c[0], 0, c[4] - c[0]} {
    k_[3] = (c[3] - c[2]) - k_[1];
    k_[5] = (c[5] - c[4]) - k_[1];
    k_[6] = (c[6] - c[4]) - k_[2];
    k_[7] = ((c[7] - c[6]) - (c[5] - c[4])) - k_[3];
  }

  double value(const Vec3& u) const {
    return (k_[0] + k_[1] * u.x + u.y * (k_[2] + k_[3] * u.x)) +
           u.z * (k_[4] + k_[5] * u.x + u.y * (k_[6] + k_[7] * u.x));
  }
  Vec3 gradient(const Vec3& u) const {
    return {k_[1] + k_[3] * u.y + u.z * (k_[5] + k_[7] * u.y),
            k_[2] + k_[3] * u.x + u.z * (k_[6] + k_[7] * u.x),
            k_[4] + k_[5] * u.x + u.y * (k_[6] + k_[7] * u.x)};
  }

  // The values on a line, as a cubic in its parameter.
  struct Cubic {
    double c0, c1, c2, c3;
    double at(double t) const { return c0 + t * (c1 + t * (c2 + t * c3)); }
    double slope(double t) const { return c1 + t * (2 * c2 + t * 3 * c3); }
  };
  Cubic along(const Vec3& from, double value_there, const Vec3& gradient_there,
              const Vec3& d) const {
    return {value_there, dot(gradient_there, d),
            (k_[3] + k_[7] * from.z) * d.x * d.y + (k_[5] + k_[7] * from.y) * d.x * d.z +
                (k_[6] + k_[7] * from.x) * d.y * d.z,
            k_[7] * d.x * d.y * d.z};
  }

 private:
  std::array<double, 8> k_;
};

}  // namespace deliso
