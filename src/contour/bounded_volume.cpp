// SPDX-License-Identifier: MIT
#include "contour/bounded_volume.h"

namespace deliso {

std::vector<std::optional<Vec3>> component_origins(const ContourMesh& contour, const Box3& box) {
  const std::size_t count = contour.summary.components.size();
  std::vector<unsigned> faces(count, 0);
  std::vector<std::optional<Vec3>> origins(count);
  for (ContourId v = 0; v < contour.points.size(); ++v) {
    faces[contour.component[v]] |= contour.box_faces[v];
    origins[contour.component[v]] = contour.points[v];  // a near point, for accuracy
  }
  for (std::size_t c = 0; c < count; ++c) {
    if (origins[c]) origins[c] = moved_into_faces(*origins[c], faces[c], box);
  }
  return origins;
}

}  // namespace deliso
