// SPDX-License-Identifier: MIT
// The discrete restricted Voronoi diagram: the label of a vertex of T is its nearest site. Labels
// stay exact under insertion. The Voronoi cell of a new site lies in the union of the old cells of
// its Delaunay neighbors, so an insertion searches only their regions.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "contour/contour.h"
#include "delaunay/triangulation.h"

namespace deliso {

// The adjacency of T.
class ContourGraph {
 public:
  explicit ContourGraph(const ContourMesh& contour);

  // Returns the neighbors u_n of v in the order of its triangles (v, u_n, u_n+1). The ring of an
  // inner vertex is closed; that of a boundary vertex begins at the next one of its loop and ends
  // at the previous one.
  std::span<const ContourId> ring(ContourId v) const {
    return std::span(rings_).subspan(first_[v], first_[v + 1] - first_[v]);
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<ContourId> rings_;
};

class Labels {
 public:
  // Labels every vertex of T with its nearest site, a finite vertex of `triangulation`. Keeps
  // references to T and the triangulation. A walk over Delaunay neighbors begins at the label of
  // the previous vertex.
  Labels(const ContourMesh& contour, const Triangulation& triangulation);

  const ContourMesh& contour() const { return contour_; }
  // Returns ContourGraph::ring(v).
  std::span<const ContourId> ring(ContourId v) const { return graph_.ring(v); }
  const Triangulation& triangulation() const { return triangulation_; }
  SiteId label(ContourId v) const { return label_[v]; }
  const IdArray<ContourId, SiteId>& all() const { return label_; }
  double distance2_to_site(ContourId v) const { return distance2_[v]; }
  bool is_site(ContourId v) const { return distance2_[v] == 0; }
  // Returns the vertex that is further from its site; of two equally far the smaller id. `v` is
  // ignored if it is a site, `best` if it is kNoId.
  ContourId further(ContourId best, ContourId v) const {
    const double d2 = distance2_[v];
    if (d2 == 0) return best;
    if (best == kNoId) return v;
    return d2 > distance2_[best] || (d2 == distance2_[best] && v < best) ? v : best;
  }
  // Returns the furthest of `vertices` and `best` in that sense.
  ContourId furthest(std::span<const ContourId> vertices, ContourId best = kNoId) const {
    for (const ContourId v : vertices) best = further(best, v);
    return best;
  }
  // Returns the region of `site`.
  std::span<const ContourId> region(SiteId site) const { return regions_[site]; }

  // Relabels the vertices nearest to the new `site`. Returns those of its Delaunay `neighbors` that
  // lost vertices.
  std::vector<SiteId> add_site(SiteId site, std::span<const SiteId> neighbors);

 private:
  const ContourMesh& contour_;
  const Triangulation& triangulation_;
  ContourGraph graph_;
  IdArray<ContourId, SiteId> label_;
  IdArray<ContourId, double> distance2_;
  IdArray<SiteId, std::vector<ContourId>> regions_;
  IdArray<SiteId, double> radius2_;  // per site: bound on the squared distances in its region
};

}  // namespace deliso
