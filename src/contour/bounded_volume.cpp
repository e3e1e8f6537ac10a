// SPDX-License-Identifier: MIT
#include "contour/bounded_volume.h"

#include "base/triangle.h"

namespace deliso {

std::vector<std::optional<Vec3>> component_origins(const ContourMesh& contour, const Box3& box) {
  const std::size_t count = contour.summary.components.size();
  std::vector<unsigned> faces(count, 0);
  std::vector<std::optional<Vec3>> origins(count);
  for (VertexId v = 0; v < contour.points.size(); ++v) {
    faces[contour.component[v]] |= contour.box_faces[v];
    origins[contour.component[v]] = contour.points[v];  // a near point, for accuracy
  }
  for (std::size_t c = 0; c < count; ++c) {
    if (origins[c]) origins[c] = moved_into_faces(*origins[c], faces[c], box);
  }
  return origins;
}

std::vector<double> bounded_volumes(const std::vector<Vec3>& points,
                                    std::span<const std::array<VertexId, 3>> triangles,
                                    std::span<const std::uint32_t> component,
                                    std::span<const std::optional<Vec3>> origins) {
  std::vector<double> volumes(origins.size(), 0);
  for (const std::array<VertexId, 3>& t : triangles) {
    const std::uint32_t c = component[t[0]];
    if (c == kNoId || !origins[c]) continue;
    volumes[c] += sixfold_volume(*origins[c], points[t[0]], points[t[1]], points[t[2]]);
  }
  return volumes;
}

}  // namespace deliso
