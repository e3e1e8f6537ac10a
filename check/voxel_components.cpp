// SPDX-License-Identifier: MIT
#include "check/voxel_components.h"

#include <algorithm>
#include <utility>

#include "base/sorted_list.h"

namespace deliso {

VoxelComponents::VoxelComponents(const ContourMesh& contour, const Volume& volume, double tolerance)
    : volume_(volume) {
  const Vec3 least = volume.least_spacing();
  tolerance_voxels_ = tolerance / std::min({least.x, least.y, least.z});
  entries_.reserve(contour.summary.active_voxels);
  for (std::uint32_t n = 0; n < contour.triangles.size(); ++n) {
    const auto& t = contour.triangles[n];
    const Vec3 middle = (contour.points[t[0]] + contour.points[t[1]] + contour.points[t[2]]) / 3;
    const std::uint64_t voxel = voxel_number(volume.dims(), volume.voxel_at(middle));
    const std::uint32_t component = contour.component[t[0]];
    if (!entries_.empty() && entries_.back().voxel == voxel &&
        entries_.back().component == component) {
      ++entries_.back().end;
    } else {
      entries_.push_back({voxel, component, n, n + 1});
    }
  }
  // T is made voxel by voxel, so nearly always they are in order.
  const auto place = [](const Entry& e) { return std::pair(e.voxel, e.first); };
  if (!std::ranges::is_sorted(entries_, {}, place)) std::ranges::sort(entries_, {}, place);
}

std::vector<std::uint32_t> VoxelComponents::near(const Vec3& p, double reach) const {
  std::vector<std::uint32_t> components;
  for_each_near(p, reach, [&](const Entry& entry) { components.push_back(entry.component); });
  sort_unique(components);
  return components;
}

}  // namespace deliso
