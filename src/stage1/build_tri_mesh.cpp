// SPDX-License-Identifier: MIT
#include "stage1/build_tri_mesh.h"

#include <utility>

namespace deliso {

SurfaceMesh build_tri_mesh(const Triangulation& triangulation, std::vector<Triangle> facets,
                           std::vector<Dual> duals, const SiteChain& chain) {
  SurfaceMesh out;
  std::vector<Vec3> points;
  std::vector<VertexId> new_id(triangulation.vertex_capacity(), kNoId);  // by the site's number
  for (Triangle& facet : facets) {
    for (VertexId& q : facet) {
      if (new_id[q] == kNoId) {
        new_id[q] = VertexId(points.size());
        points.push_back(triangulation.point(SiteId(q.number())));
      }
      q = new_id[q];
    }
  }
  out.mesh = make_tri_mesh(std::move(points), facets);
  out.duals = std::move(duals);
  out.chain = chain.renumbered(new_id);
  return out;
}

}  // namespace deliso
