// SPDX-License-Identifier: MIT
// The components of T in each voxel. A point of Sigma in a voxel lies on one of these, so a voxel
// with a single component tells exactly which, however close other components come.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "contour/contour.h"
#include "volume/volume.h"

namespace deliso {

class VoxelComponents {
 public:
  // Keeps a reference to the volume. `tolerance`: of points on Sigma, in the scaled frame.
  VoxelComponents(const ContourMesh& contour, const Volume& volume, double tolerance);

  // Returns the components in the voxel that holds p, and in those within the tolerance of p;
  // ascending.
  std::vector<std::uint32_t> at(const Vec3& p) const { return near(p, tolerance_voxels_); }
  // The same, of that voxel and its neighbors.
  std::vector<std::uint32_t> around(const Vec3& p) const { return near(p, 1); }
  // Calls visit(voxel) for every voxel that T passes through, once per component there.
  template <class Visit>
  void for_each_voxel(Visit&& visit) const {
    for (const auto& entry : entries_) visit(numbered_voxel(volume_.dims(), entry.first));
  }

 private:
  // Of the voxels within `reach` voxels of p along every axis.
  std::vector<std::uint32_t> near(const Vec3& p, double reach) const;

  const Volume& volume_;
  double tolerance_voxels_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> entries_;  // voxel, component; ascending
};

}  // namespace deliso
