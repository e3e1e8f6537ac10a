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
    for (const ContourId v : contour.boundary.chain(loop)) {
      places.push_back({loop, static_cast<double>(vertices.size())});
      vertices.push_back(VertexId(v.number()));
    }
    out.chain.add_loop(vertices, places);
  }
  return out;
}

BoundaryLoops boundary_loops(const ContourMesh& contour, unsigned inner) {
  const BoundaryChains& chains = contour.boundary;
  BoundaryLoops loops(chains.size());
  for (std::size_t c = 0; c < loops.size(); ++c) {
    BoundaryLoop& loop = loops[c];
    for (std::uint32_t k = chains.first[c]; k < chains.first[c + 1]; ++k) {
      loop.points.push_back(contour.points[chains.vertices[k]]);
      loop.kept.push_back(chains.on_box_edge[k]);
      loop.faces.push_back(chains.face[k]);
      loop.fixed.push_back(inner >> chains.face[k] & 1);
    }
    for (std::size_t k = 0; k < loop.kept.size(); ++k) {
      loop.kept[k] |= is_on_fixed(loop, static_cast<double>(k));
    }
  }
  return loops;
}

}  // namespace deliso
