// SPDX-License-Identifier: MIT
// The discrete restricted Voronoi diagram: every vertex of the exact contour T labeled with its
// nearest site, kept exact under insertion. A new site can only take vertices from its Delaunay
// neighbors (its Voronoi cell lies within the union of their old ones), so an insertion looks at
// their lists and at nothing else.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "contour/contour.h"
#include "delaunay/triangulation.h"

namespace deliso {

// T's adjacency.
class ContourGraph {
 public:
  ContourGraph(const ContourMesh& contour, int threads);

  // The neighbors of v in order round it, as the triangles (v, u_n, u_n+1) run: closed for inner
  // vertices; on a boundary chain from the next vertex there to the one before.
  std::span<const VertexId> ring(VertexId v) const {
    return std::span(rings_).subspan(first_[v], first_[v + 1] - first_[v]);
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<VertexId> rings_;
};

class Labels {
 public:
  // Labels every vertex of T with its nearest site: a walk over Delaunay neighbors, begun at the
  // label of the vertex before, so T is best in an order that keeps neighbors together
  // (contour/block_order.h). Sites are the finite vertices of `triangulation`. Components with
  // kept[c] == 0 stay without labels. Keeps references to both.
  Labels(const ContourMesh& contour, const Triangulation& triangulation,
         std::span<const std::uint8_t> kept, int threads);

  const ContourMesh& contour() const { return contour_; }
  // As the graph's.
  std::span<const VertexId> ring(VertexId v) const { return graph_.ring(v); }
  const Triangulation& triangulation() const { return triangulation_; }
  SiteId label(VertexId v) const { return label_[v]; }
  const IdArray<VertexId, SiteId>& all() const { return label_; }
  double distance2_to_site(VertexId v) const { return distance2_[v]; }
  bool is_site(VertexId v) const { return label_[v] != kNoId && distance2_[v] == 0; }
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

  // Takes what belongs to the new `site` from its Delaunay neighbors; returns those that lost
  // vertices.
  std::vector<SiteId> add_site(SiteId site, std::span<const SiteId> neighbors);

 private:
  const ContourMesh& contour_;
  const Triangulation& triangulation_;
  ContourGraph graph_;
  IdArray<VertexId, SiteId> label_;
  IdArray<VertexId, double> distance2_;
  IdArray<SiteId, std::vector<VertexId>> regions_;
  IdArray<SiteId, double> reach2_;  // per site, squared: nothing in its region is further from it
};

}  // namespace deliso
