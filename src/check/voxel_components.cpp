// SPDX-License-Identifier: MIT
#include "check/voxel_components.h"

#include <algorithm>
#include <cmath>

#include "base/sorted_list.h"

namespace deliso {

VoxelComponents::VoxelComponents(const ContourMesh& contour, const Volume& volume, double tolerance)
    : volume_(volume) {
  const Vec3 spacing = volume.spacing();
  tolerance_voxels_ = tolerance / std::min({spacing.x, spacing.y, spacing.z});
  for (const std::array<VertexId, 3>& t : contour.triangles) {
    const Vec3 middle = (contour.points[t[0]] + contour.points[t[1]] + contour.points[t[2]]) / 3;
    const std::pair entry(voxel_number(volume.dims(), volume.voxel_at(middle)),
                          contour.component[t[0]]);
    if (entries_.empty() || entries_.back() != entry) entries_.push_back(entry);
  }
  sort_unique(entries_);
}

std::vector<std::uint32_t> VoxelComponents::near(const Vec3& p, double reach) const {
  Index3 lo, hi, voxel;
  for (int axis = 0; axis < 3; ++axis) {
    const double u = volume_.in_samples(p, axis), last = volume_.voxels()[axis] - 1;
    if (!(u >= -reach && u <= last + 1 + reach)) return {};
    lo[axis] = static_cast<int>(std::clamp(std::floor(u - reach), 0.0, last));
    hi[axis] = static_cast<int>(std::clamp(std::floor(u + reach), 0.0, last));
  }
  std::vector<std::uint32_t> components;
  for (voxel.k = lo.k; voxel.k <= hi.k; ++voxel.k) {
    for (voxel.j = lo.j; voxel.j <= hi.j; ++voxel.j) {
      // Voxels of a row are numbered one after another.
      voxel.i = lo.i;
      const std::uint64_t first = voxel_number(volume_.dims(), voxel);
      const std::uint64_t end = first + static_cast<std::uint64_t>(hi.i - lo.i) + 1;
      auto at = std::lower_bound(entries_.begin(), entries_.end(), std::pair(first, 0u));
      for (; at != entries_.end() && at->first < end; ++at) components.push_back(at->second);
    }
  }
  sort_unique(components);
  return components;
}

}  // namespace deliso
