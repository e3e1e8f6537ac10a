// SPDX-License-Identifier: MIT
#include "coarsen/contour_as_mesh.h"

#include <vector>

namespace deliso {

SurfaceMesh contour_as_mesh(const ContourMesh& contour) {
  SurfaceMesh out;
  out.mesh = make_tri_mesh(contour.points, contour.triangles);
  std::vector<CurvePlace> places;
  for (std::uint32_t loop = 0; loop < contour.boundary.size(); ++loop) {
    const std::vector<VertexId>& vertices = contour.boundary.vertices[loop];
    places.clear();
    for (std::size_t s = 0; s < vertices.size(); ++s) {
      places.push_back({loop, static_cast<double>(s)});
    }
    out.chain.add_loop(vertices, places);
  }
  return out;
}

}  // namespace deliso
