// SPDX-License-Identifier: MIT
// Intersect(f, kappa, r) of paper Figure 12: the points of Sigma on a segment. CollectVoxels goes
// through the kd-tree (§4.1), FindIntersections solves the cubic of each voxel (§4.2).
#pragma once

#include <span>
#include <vector>

#include "isosurface/isosurface.h"
#include "kdtree/voxel_tree.h"
#include "paper/options.h"

namespace deliso::paper {

// Sigma as the routines of the paper meet it. Keeps references.
class Sigma {
 public:
  Sigma(const VoxelTree& tree, double kappa, CubicMethod solver)
      : tree_(tree), solver_(solver), by_steps_(tree.volume(), kappa, solver) {}

  const Volume& volume() const { return tree_.volume(); }
  double kappa() const { return by_steps_.kappa(); }
  bool is_empty() const { return !tree_.active(kappa()); }

  // Returns the points of Sigma on r, in order. Valid until the next call.
  std::span<const Hit> intersect(const Segment& r, SearchCounters& counters);
  // Returns the point of Sigma on the line that is nearest to `center`: Stage 2's search, voxel by
  // voxel from there in both directions (§2.2.3, §4.2). pre: `direction` has unit length.
  std::optional<Hit> nearest(const Vec3& center, const Vec3& direction, double limit,
                             SearchCounters& counters) const {
    return by_steps_.nearest(center, direction, limit, counters);
  }

 private:
  const VoxelTree& tree_;
  CubicMethod solver_;
  Isosurface by_steps_;
  std::vector<VoxelSpan> voxels_;
  std::vector<Hit> hits_;
};

}  // namespace deliso::paper
