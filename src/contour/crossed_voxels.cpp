// SPDX-License-Identifier: MIT
#include "contour/crossed_voxels.h"

#include <algorithm>
#include <cstddef>

#include "embedding/triangle_pair.h"
#include "exact/predicates.h"

namespace deliso {

std::vector<std::uint64_t> crossed_voxels(const ContourMesh& contour,
                                          std::span<const std::uint64_t> among) {
  std::vector<std::uint64_t> out;
  std::vector<Triangle> triangles;
  std::vector<Box3> boxes;
  const auto add = [&](const ContourTriangle& v) {
    const Vec3 &a = contour.points[v[0]], &b = contour.points[v[1]], &c = contour.points[v[2]];
    if (collinear(a, b, c)) return;
    triangles.push_back(triangle_of(v[0], v[1], v[2]));
    boxes.push_back(box_of(a, b, c));
  };
  const auto meets_earlier = [&](std::size_t g) {
    for (std::size_t f = 0; f < g; ++f) {
      if (meet(boxes[f], boxes[g]) &&
          triangles_intersect(contour.points, triangles[f], triangles[g])) {
        return true;
      }
    }
    return false;
  };
  for (auto crowd = contour.crowded.begin(); crowd != contour.crowded.end();) {
    const std::uint64_t voxel = crowd->voxel;
    triangles.clear();
    boxes.clear();
    const bool is_asked = among.empty() || std::ranges::binary_search(among, voxel);
    for (; crowd != contour.crowded.end() && crowd->voxel == voxel; ++crowd) {
      for (std::size_t t = crowd->first; is_asked && t < crowd->end; ++t) {
        add(contour.triangles[t]);
      }
    }
    for (std::size_t g = 1; g < triangles.size(); ++g) {
      if (!meets_earlier(g)) continue;
      out.push_back(voxel);
      break;
    }
  }
  return out;
}

}  // namespace deliso
