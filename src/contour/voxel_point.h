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

  // The values on a line, as a cubic in its parameter.
  struct Cubic {
    double c0, c1, c2, c3;
    double at(double t) const { return c0 + t * (c1 + t * (c2 + t * c3)); }
    double slope(double t) const { return c1 + t * (2 * c2 + t * 3 * c3); }
  };
  Cubic along(const Vec3& from, double value_there, const Vec3& gradient_there,
              const Vec3& direction) const;

  // Returns a point of Sigma near `from`, strictly within the voxel, and if possible a thousandth
  // of it from its faces. Newton's method nearly always finds one near by, on the line along the
  // gradient. Otherwise it is the nearest sign change on the lines along the gradient, along the
  // axes and to the corners on the other side. Each of the last has a sign change. (If a corner
  // equals kappa, Sigma may only touch the voxel there; then the corner is the point.) pre: the
  // corners' values have both signs (zero counts as positive).
  Vec3 surface_point_near(const Vec3& from) const;

 private:
  // Returns a point on those lines at least `clearance` from the voxel's faces; nothing if no line
  // has one. pre: `from` is as far from them.
  std::optional<Vec3> surface_point_within(const Vec3& from, double clearance) const;

  // Returns a root in (0, limit], by Newton's method from 0; nothing if it strays or is slow.
  static std::optional<double> newton(const Cubic& f, double limit);
  // Returns a root in (0, limit]; negative if f has the same sign at both ends.
  static double first_sign_change(const Cubic& f, double limit);

  Corners corners_;
  std::array<double, 8> k_;
};

}  // namespace deliso
