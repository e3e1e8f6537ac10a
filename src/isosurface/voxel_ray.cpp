// SPDX-License-Identifier: MIT
#include "isosurface/voxel_ray.h"

#include <algorithm>

namespace deliso {

double parameter_at(const VoxelSpan& span, double s) {
  return std::clamp(span.t0 + s * (span.t1 - span.t0), span.t0, span.t1);
}

// From the voxel's own coordinates, not from the parameter: that keeps the point in the voxel and g
// there at kappa even where t is large.
Vec3 point_at(const VoxelSpan& span, double s, const Vec3& spacing) {
  Vec3 point;
  for (int axis = 0; axis < 3; ++axis) {
    const double u = span.u0[axis] + s * (span.u1[axis] - span.u0[axis]);
    point[axis] = (span.voxel[axis] + std::clamp(u, 0.0, 1.0)) * spacing[axis];
  }
  return point;
}

}  // namespace deliso
