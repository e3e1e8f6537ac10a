// SPDX-License-Identifier: MIT
// The trilinear interpolant around a point, in its voxel, expanded at the point. Along a line
// through the point it is a cubic in powers of the distance. Most points that are asked about are
// so near to Sigma that this cubic alone tells the distance, without a walk over voxels.
#pragma once

#include <optional>

#include "isosurface/isosurface.h"
#include "volume/trilinear_patch.h"

namespace deliso {

class PatchAt {
 public:
  // Keeps a reference: the surface must outlive the patch.
  PatchAt(const Isosurface& surface, const Vec3& p);

  const Vec3& point() const { return p_; }
  // Returns the gradient of g at the point, clamped to the box.
  Vec3 gradient() const { return times(slope_, per_side_); }

  // Returns what Isosurface::nearest() returns from the point, but for rounding.
  std::optional<Hit> nearest(const Vec3& direction, double limit, SearchCounters& counters) const;

  // Returns where the point of Sigma nearest along the line in this direction is, at a signed
  // distance; infinite if it is further than `limit`, or if the direction has no length or is not
  // finite.
  double parameter_along(const Vec3& direction, double limit, SearchCounters& counters) const;

 private:
  PatchAt(const Isosurface& surface, const Vec3& p, const VoxelUnits::Local& at);
  std::optional<double> parameter_within(const Vec3& direction, double limit) const;

  const Isosurface& surface_;
  Vec3 p_;
  TrilinearPatch patch_;
  Vec3 per_side_;  // of the voxel
  // In units of the voxel. `u_` lies in the voxel; `room_`: from the point to the voxel's nearer
  // face.
  Vec3 u_, room_;
  double value_;  // less kappa
  Vec3 slope_;
};

}  // namespace deliso
