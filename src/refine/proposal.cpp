// SPDX-License-Identifier: MIT
#include "refine/proposal.h"

#include <algorithm>

namespace deliso {

Proposal Cavity::cone(const Vec3& p, const Gates& gates, const BoundarySplit* split) const {
  Proposal made(number_, gates, Proposal::Vertex::comes, next_, p);
  if (split) made.split = *split;
  return made;
}

void Replacement::fill_cone() {
  in_.facets.clear();
  for (const Disk::BoundaryEdge& edge : cavity.disk.boundary) {
    if (proposal.split && cavity.facets[edge.facet] == proposal.split->edge.face &&
        edge.side == proposal.split->edge.index) {
      continue;
    }
    in_.facets.push_back({edge.from, edge.to, proposal.vertex});
  }
}

Proposal Cavity::move(VertexId v, const Vec3& p, const Gates& gates) const {
  return Proposal(number_, gates, Proposal::Vertex::moves, v, p);
}

Proposal Cavity::merge(VertexId from, VertexId to, const Gates& gates) const {
  Proposal made(number_, gates);
  made.facets.reserve(disk.facets.size());
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
