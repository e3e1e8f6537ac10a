// SPDX-License-Identifier: MIT
// The components of T in each voxel. A point of Sigma in a voxel lies on one of these, so a voxel
// with a single component tells exactly which, however close other components come.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
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
  // True if the component is in the voxel that holds p, or in one within `reach` voxels of p.
  bool has_near(const Vec3& p, double reach, std::uint32_t component) const {
    bool has = false;
    for_each_near(p, reach, [&](const Entry& entry) { has |= entry.component == component; });
    return has;
  }
  // Calls visit(number) for the triangles of T in these voxels.
  template <class Visit>
  void for_each_triangle_around(const Vec3& p, Visit&& visit) const {
    for_each_near(p, 1, [&](const Entry& entry) {
      for (std::uint32_t n = entry.first; n < entry.end; ++n) visit(n);
    });
  }

 private:
  // Triangles first .. end-1 of T, of one component, are in this voxel.
  struct Entry {
    std::uint64_t voxel;
    std::uint32_t component, first, end;
  };
  // Calls visit(entry) for the voxels within `reach` voxels of p along every axis.
  template <class Visit>
  void for_each_near(const Vec3& p, double reach, Visit&& visit) const;
  std::vector<std::uint32_t> near(const Vec3& p, double reach) const;

  const Volume& volume_;
  double tolerance_voxels_;
  std::vector<Entry> entries_;  // by voxel, then triangle
};

template <class Visit>
void VoxelComponents::for_each_near(const Vec3& p, double reach, Visit&& visit) const {
  Index3 lo, hi, voxel;
  for (int axis = 0; axis < 3; ++axis) {
    const double u = volume_.in_samples(p, axis), last = volume_.voxels()[axis] - 1;
    if (!(u >= -reach && u <= last + 1 + reach)) return;
    lo[axis] = static_cast<int>(std::clamp(std::floor(u - reach), 0.0, last));
    hi[axis] = static_cast<int>(std::clamp(std::floor(u + reach), 0.0, last));
  }
  for (voxel.k = lo.k; voxel.k <= hi.k; ++voxel.k) {
    for (voxel.j = lo.j; voxel.j <= hi.j; ++voxel.j) {
      // Voxels of a row are numbered one after another.
      voxel.i = lo.i;
      const std::uint64_t first = voxel_number(volume_.dims(), voxel);
      const std::uint64_t end = first + static_cast<std::uint64_t>(hi.i - lo.i) + 1;
      auto at = std::ranges::lower_bound(entries_, first, {}, &Entry::voxel);
      for (; at != entries_.end() && at->voxel < end; ++at) visit(*at);
    }
  }
}

}  // namespace deliso
