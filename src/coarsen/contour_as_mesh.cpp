// SPDX-License-Identifier: MIT
#include "coarsen/contour_as_mesh.h"

#include <vector>

namespace deliso {

SurfaceMesh contour_as_mesh(const ContourMesh& contour) {
  SurfaceMesh out;
  out.mesh.points = contour.points;
  out.mesh.faces.reserve(contour.triangles.size());
  for (const ContourTriangle& t : contour.triangles) {
    out.mesh.faces.push_back({triangle_of(t[0], t[1], t[2]), {kNoId, kNoId, kNoId}});
  }
  link_faces(out.mesh);
  std::vector<VertexId> vertices;
  std::vector<CurvePlace> places;
  for (std::uint32_t loop = 0; loop < contour.boundary.size(); ++loop) {
    vertices.clear();
    places.clear();
    for (const ContourId v : contour.boundary.vertices[loop]) {
      places.push_back({loop, static_cast<double>(vertices.size())});
      vertices.emplace_back(v.number());
    }
    out.chain.add_loop(vertices, places);
  }
  return out;
}

}  // namespace deliso
