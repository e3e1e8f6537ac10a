// SPDX-License-Identifier: MIT
#include "paper/intersect.h"

#include "isosurface/voxel_ray.h"

namespace deliso::paper {

std::span<const Hit> Sigma::intersect(const Segment& r, SearchCounters& counters) {
  tree_.collect_voxels(r, kappa(), voxels_);
  hits_.clear();
  for (const VoxelSpan& span : voxels_) {
    const Roots roots = find_intersections(volume().corners(span.voxel, kappa()), span, solver_);
    for (int n = 0; n < roots.count; ++n) {
      hits_.push_back(
          {parameter_at(span, roots.t[n]), point_at(span, roots.t[n], volume()), roots.leaves(n)});
    }
  }
  counters += {1, !hits_.empty(), voxels_.size(), hits_.empty() ? 0 : voxels_.size()};
  return hits_;
}

}  // namespace deliso::paper
