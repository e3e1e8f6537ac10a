// SPDX-License-Identifier: MIT
#include "recover/certificate.h"

#include <algorithm>

namespace deliso {

VertexId Certificate::furthest_between(SiteId a, SiteId b) const {
  VertexId furthest = kNoId;
  for (const VertexId v : labels_.region(a)) {
    for (const VertexId u : labels_.ring(v)) {
      if (labels_.label(u) != b) continue;
      furthest = labels_.further(labels_.further(furthest, v), u);
    }
  }
  return furthest;
}

Verdict Certificate::check(SiteId a, VertexId at, std::vector<DualFacet>& facets) {
  interfaces_.clear();
  facets.clear();
  long directed = 0, thrice_faces = 0;
  long boundary_vertices = 0, boundary_edges = 0;

  // One breadth-first pass from the site's own vertex through its region. Every neighbor in the
  // region is written at reached[count]; it stays there only if it was not visited before.
  const std::span<const VertexId> region = labels_.region(a);
  const IdArray<VertexId, SiteId>& label = labels_.all();
  reached_.resize(std::max(reached_.size(), region.size() + 1));
  const std::span<VertexId> reached = reached_;
  IdArray<VertexId, std::uint32_t>& visited = visited_;
  const ContourMesh& contour = labels_.contour();
  const std::uint32_t now = ++checks_;
  reached[0] = at;
  visited[at] = now;
  std::size_t count = 1;
  for (std::size_t k = 0; k < count; ++k) {
    const VertexId v = reached[k];
    const std::span<const VertexId> ring = labels_.ring(v);
    std::size_t inside = 0;
    for (const VertexId u : ring) {
      if (label[u] != a) continue;
      ++inside;
      reached[count] = u;
      count += visited[u] != now;
      visited[u] = now;
    }
    const bool on_boundary = contour.on_boundary(v);
    const std::size_t triangles = ring.size() - on_boundary;
    if (inside == ring.size()) {  // the most frequent case
      directed += static_cast<long>(triangles);
      thrice_faces += static_cast<long>(triangles);
    } else {
      for (std::size_t n = 0; n < triangles; ++n) {
        const VertexId u = ring[n], w = ring[n + 1 < ring.size() ? n + 1 : 0];
        const SiteId x = label[u], y = label[w];
        // Counts the directed edge v -> u and the triangle (v, u, w). An inner edge is counted from
        // both ends, a triangle once from each of its vertices labeled a.
        if (x == a) {
          ++directed;
          ++(y == a ? thrice_faces : interface_with(y).twice_faces);
          continue;
        }
        Interface& i = interface_with(x);
        ++i.edges;
        if (y == a) {
          ++i.twice_faces;
        } else if (y == x) {
          i.twice_faces += 2;
        } else {
          facets.push_back({{a, x, y}, {v, u, w}});
        }
      }
    }
    if (!on_boundary) continue;
    ++boundary_vertices;
    // A boundary edge has only one direction, from the previous vertex to v.
    const SiteId before = label[ring.back()], next = label[ring.front()];
    if (before == a) {
      ++boundary_edges;
    } else {
      Interface& i = interface_with(before);
      ++i.edges;
      ++i.boundary_edges;
    }
    if (next != a) ++interface_with(next).boundary_edges;
  }

  if (count != region.size()) {
    VertexId stray = kNoId;
    for (const VertexId v : region) {
      if (visited[v] != now) stray = labels_.further(stray, v);
    }
    return {Reason::region, stray};
  }
  const long vertices = static_cast<long>(region.size()), edges = (directed + boundary_edges) / 2;
  if (vertices - edges + thrice_faces / 3 != 1) return {Reason::region, labels_.furthest(region)};
  if (boundary_vertices > 0) {
    if (!contour.on_boundary(at) || boundary_vertices - boundary_edges != 1) {
      VertexId furthest = kNoId;
      for (const VertexId v : region) {
        if (contour.on_boundary(v)) furthest = labels_.further(furthest, v);
      }
      return {Reason::boundary, furthest};
    }
  }
  for (const Interface& i : interfaces_) {
    if (i.boundary_edges > 1) return {Reason::boundary, furthest_between(a, i.site)};
    if (2 * i.edges - i.twice_faces != 2) return {Reason::interface, furthest_between(a, i.site)};
  }
  for (std::size_t i = 0; i < facets.size(); ++i) {
    for (std::size_t j = i + 1; j < facets.size(); ++j) {
      const auto &s = facets[i].sites, &t = facets[j].sites;
      const bool same = (s[1] == t[1] && s[2] == t[2]) || (s[1] == t[2] && s[2] == t[1]);
      if (!same) continue;
      return {Reason::triple,
              labels_.furthest(facets[j].t_triangle, labels_.furthest(facets[i].t_triangle))};
    }
  }
  return {};
}

}  // namespace deliso
