// SPDX-License-Identifier: MIT
// The discrete restricted Voronoi diagram: every vertex of the exact contour T labelled with its
// nearest site, kept exact under insertion. A new site can only take vertices from its Delaunay
// neighbours (its Voronoi cell lies within the union of their old ones), so an insertion looks at
// their lists and at nothing else.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "contour/contour.h"
#include "delaunay/triangulation.h"
#include "surface/boundary.h"

namespace deliso {

// T's adjacency, and where its boundary chains run.
class ContourGraph {
 public:
  ContourGraph(const ContourMesh& contour, int threads);

  // The neighbours of v in order round it, as the triangles (v, u_n, u_n+1) run: closed for inner
  // vertices; on a boundary chain from the next vertex there to the one before.
  std::span<const VertexId> ring(VertexId v) const {
    return std::span(rings_).subspan(first_[v], first_[v + 1] - first_[v]);
  }
  // Along the boundary chain, as the triangles run; kNoId for inner vertices.
  VertexId chain_next(VertexId v) const { return along(next_, v); }
  VertexId chain_previous(VertexId v) const { return along(previous_, v); }
  // pre: v lies on a boundary chain.
  CurvePlace chain_place(VertexId v) const { return place_[slot_[v]]; }

 private:
  VertexId along(const std::vector<VertexId>& others, VertexId v) const {
    return slot_[v] == kNoId ? VertexId(kNoId) : others[slot_[v]];
  }

  std::vector<std::uint32_t> first_;
  std::vector<VertexId> rings_;
  IdArray<VertexId, std::uint32_t> slot_;  // per vertex, into the next three; kNoId for inner ones
  std::vector<VertexId> next_, previous_;
  std::vector<CurvePlace> place_;
};

class Labels {
 public:
  // Labels every vertex of T with its nearest site: a walk over Delaunay neighbours, begun at the
  // label of the vertex before, so T is best in an order that keeps neighbours together
  // (contour/block_order.h). Sites are the finite vertices of `triangulation`. Components with
  // kept[c] == 0 stay without labels.
  Labels(const ContourMesh& contour, const Triangulation& triangulation,
         std::span<const std::uint8_t> kept, int threads);

  SiteId label(VertexId v) const { return label_[v]; }
  const IdArray<VertexId, SiteId>& all() const { return label_; }
  double distance2_to_site(VertexId v) const { return distance2_[v]; }
  // The further of two vertices of T from its site, the smaller one of two as far; sites themselves
  // never win. kNoId: none.
  VertexId further(VertexId best, VertexId v) const {
    const double d2 = distance2_[v];
    if (d2 == 0) return best;
    if (best == kNoId) return v;
    return d2 > distance2_[best] || (d2 == distance2_[best] && v < best) ? v : best;
  }
  VertexId furthest(std::span<const VertexId> vertices, VertexId best = kNoId) const {
    for (const VertexId v : vertices) best = further(best, v);
    return best;
  }
  // The vertices of T nearest to `site`.
  std::span<const VertexId> region(SiteId site) const { return regions_[site]; }

  // Takes what belongs to the new `site` from its Delaunay neighbours; appends those that lost
  // vertices to `changed`.
  void add_site(SiteId site, const Triangulation& triangulation, std::span<const SiteId> neighbors,
                std::vector<SiteId>& changed);

 private:
  const ContourMesh& contour_;
  IdArray<VertexId, SiteId> label_;
  IdArray<VertexId, double> distance2_;
  IdArray<SiteId, std::vector<VertexId>> regions_;
  IdArray<SiteId, double> reach2_;  // per site, squared: nothing in its region is further from it
};

// What an observer sees of the certified way.
struct LabelState {
  const ContourMesh& contour;
  const ContourGraph& graph;
  const Labels& labels;
  const Triangulation& triangulation;
  Box3 box;
};

}  // namespace deliso
