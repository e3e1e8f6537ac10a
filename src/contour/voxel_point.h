// SPDX-License-Identifier: MIT
// A point of Sigma inside a voxel, near a given point: the center of the star of triangles that
// fills a loop of the contour. Coordinates are the voxel's own, [0, 1] along each axis.
#pragma once

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

  // A point of Sigma near `from` within the voxel. It first goes down (or up) the gradient, and
  // where that line leaves the voxel without meeting Sigma, or meets it far away, takes the nearest
  // hit of the lines along the axes and to the corners on the other side; of the latter each must
  // hit, since the value changes sign along it. (Where a corner equals kappa Sigma may only touch
  // the voxel there; then it is the point.)
  // pre: the corners' values have both signs (zero counts as positive).
  Vec3 surface_point_near(const Vec3& from) const;

 private:
  // Where the line from + t * direction first seems to meet Sigma for t in (0, limit]; the root is
  // good to rounding. Negative when the value has the same sign at both ends.
  double hit(const Vec3& from, double value, const Vec3& direction, double limit) const;

  Corners corners_;
  std::array<double, 8> k_;
};

}  // namespace deliso
