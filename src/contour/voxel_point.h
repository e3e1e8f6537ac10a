// SPDX-License-Identifier: MIT
// A point of Sigma inside a voxel, near a given point: the center of the star of triangles that
// fills a loop of the contour. Coordinates are the voxel's own, [0, 1] along each axis.
#pragma once

#include <array>
#include <optional>

#include "base/vec3.h"
#include "volume/volume.h"

namespace deliso {

// The trilinear polynomial of a voxel: value = sum of coefficients times 1, x, y, xy, z, xz, yz,
// xyz, in the order of the corners.
class TrilinearPatch {
 public:
  explicit TrilinearPatch(const Corners& c);  // values minus kappa

  double value(const Vec3& u) const;
  Vec3 gradient(const Vec3& u) const;

  // A point of Sigma near `from`, strictly within the voxel, and a thousandth of it away from its
  // faces where that can be had: on the line along the gradient where
  // Newton's method finds it near by (nearly always), else the nearest of those where the lines
  // along the gradient, along the axes and to the corners on the other side change sign. Each of
  // the latter does. (Where a corner equals kappa Sigma may only touch the voxel there; then it is
  // the point.) pre: the corners' values have both signs (zero counts as positive).
  Vec3 surface_point_near(const Vec3& from) const;

 private:
  // The values on a line, in its parameter.
  struct Cubic {
    double c0, c1, c2, c3;
    double at(double t) const { return c0 + t * (c1 + t * (c2 + t * c3)); }
    double slope(double t) const { return c1 + t * (2 * c2 + t * 3 * c3); }
  };
  // A point on those lines, this far from the voxel's faces; none where no line has one.
  // pre: `from` is as far from them.
  std::optional<Vec3> surface_point_within(const Vec3& from, double clearance) const;
  Cubic along(const Vec3& from, double value_there, const Vec3& gradient_there,
              const Vec3& direction) const;

  // A root in (0, limit], by Newton's method from 0; nothing when it strays or is slow.
  static std::optional<double> newton(const Cubic& f, double limit);
  // A root in (0, limit]; negative when f has the same sign at both ends.
  static double first_sign_change(const Cubic& f, double limit);

  Corners corners_;
  std::array<double, 8> k_;
};

}  // namespace deliso
