// SPDX-License-Identifier: MIT
// A point of Sigma inside a voxel, near a given point: the center of the star of triangles that
// fills a loop of the contour. Coordinates are the voxel's own, [0, 1] along each axis.
#pragma once

#include <optional>

#include "volume/trilinear_patch.h"

namespace deliso {

// The patch of a voxel in which a point of Sigma is sought.
class VoxelPatch : public TrilinearPatch {
 public:
  explicit VoxelPatch(const Corners& c) : TrilinearPatch(c), corners_(c) {}  // values minus kappa

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
};

}  // namespace deliso
