// SPDX-License-Identifier: MIT
#include "refine/proposal.h"

#include <algorithm>

namespace deliso {

Proposal Cavity::cone(const Vec3& p, const Gates& gates, const BoundarySplit* split) const {
  Proposal made(number_, gates, Proposal::Vertex::comes, next_, p);
  if (split) made.split = *split;
  made.facets.reserve(disk.boundary.size());
  for (const Disk::BoundaryEdge& edge : disk.boundary) {
    if (split && facets[edge.facet] == split->edge.face && edge.side == split->edge.index) continue;
    made.facets.push_back({edge.from, edge.to, next_});
  }
  return made;
}

Proposal Cavity::move(VertexId v, const Vec3& p, const Gates& gates) const {
  return Proposal(number_, gates, Proposal::Vertex::moves, v, p);
}

Proposal Cavity::merge(VertexId from, VertexId to, const Gates& gates) const {
  Proposal made(number_, gates);
  for (Triangle t : disk.facets) {
    if (has_corner(t, to)) continue;
    std::ranges::replace(t, from, to);
    made.facets.push_back(t);
  }
  return made;
}

Proposal Cavity::fill(std::span<const Triangle> list, const Gates& gates) const {
  Proposal made(number_, gates);
  made.facets.assign(list.begin(), list.end());
  return made;
}

}  // namespace deliso
