// SPDX-License-Identifier: MIT
// The trilinear interpolant around a point, in its voxel, expanded at the point. Along a line
// through the point it is a cubic in powers of the distance. Most points that a check measures are
// so near to Sigma that this cubic alone tells the distance, without a walk over voxels.
#pragma once

#include <optional>

#include "isosurface/isosurface.h"

namespace deliso {

class PatchAt {
 public:
  // Keeps a reference: the surface must outlive the patch.
  PatchAt(const Isosurface& surface, const Vec3& p);

  // Returns the gradient of g at the point, clamped to the box.
  Vec3 gradient() const { return times(slope_, per_spacing_); }

  // Returns the distance to the point of Sigma nearest along the line in this direction; infinite
  // if it is further than `limit`, or if the direction has no length or is not finite.
  double distance_along(const Vec3& direction, double limit, SearchCounters& counters) const;

 private:
  static Vec3 times(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  std::optional<double> distance_within(const Vec3& direction) const;

  const Isosurface& surface_;
  Vec3 p_;
  // In units of voxels.
  Vec3 per_spacing_, room_;  // room_: from the point to the nearer face of the voxel
  double value_;             // less kappa
  Vec3 slope_, twist_;       // d/dx, d/dy, d/dz; d/dydz, d/dzdx, d/dxdy
  double third_;             // d/dxdydz
};

}  // namespace deliso
