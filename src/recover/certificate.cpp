// SPDX-License-Identifier: MIT
#include "recover/certificate.h"

#include <algorithm>

namespace deliso {

ContourId Certificate::furthest_between(SiteId a, SiteId b) const {
  ContourId furthest = kNoId;
  for (const ContourId v : labels_.region(a)) {
    for (const ContourId u : labels_.ring(v)) {
      if (labels_.label(u) != b) continue;
      furthest = labels_.further(labels_.further(furthest, v), u);
    }
  }
  return furthest;
}

Certificate::Region Certificate::count_region(SiteId a, ContourId at,
                                              std::vector<DualFacet>& facets) {
  Region r;
  interfaces_.clear();
  facets.clear();
  // One breadth-first pass from the site's own vertex. Every neighbor in the region is written at
  // reached[count]; it stays there only if it was not visited before.
  const IdArray<ContourId, SiteId>& label = labels_.all();
  IdArray<ContourId, std::uint32_t>& visited = visited_;
  reached_.resize(std::max(reached_.size(), labels_.region(a).size() + 1));
  const std::span<ContourId> reached = reached_;
  const std::uint32_t now = ++checks_;
  reached[0] = at;
  visited[at] = now;
  std::size_t count = 1;
  for (std::size_t k = 0; k < count; ++k) {
    const ContourId v = reached[k];
    for (const ContourId u : labels_.ring(v)) {
      if (label[u] != a) continue;
      reached[count] = u;
      count += visited[u] != now;
      visited[u] = now;
    }
    count_at(a, v, r, facets);
  }
  // An inner edge is met from both ends, a triangle once from each of its vertices in the region.
  r.V = static_cast<long>(count);
  r.E = (r.E + r.boundary_E) / 2;
  r.F /= 3;
  return r;
}

void Certificate::count_at(SiteId a, ContourId v, Region& r, std::vector<DualFacet>& facets) {
  const IdArray<ContourId, SiteId>& label = labels_.all();
  const std::span<const ContourId> ring = labels_.ring(v);
  const bool on_boundary = labels_.contour().on_boundary(v);
  const std::size_t triangles = ring.size() - on_boundary;
  for (std::size_t n = 0; n < triangles; ++n) {  // the edge (v, u), the triangle (v, u, w)
    const ContourId u = ring[n], w = ring[n + 1 < ring.size() ? n + 1 : 0];
    const SiteId b = label[u], c = label[w];
    if (b == a) {
      ++r.E;
      ++(c == a ? r.F : interface_with(c).F);
      continue;
    }
    Interface& i = interface_with(b);
    ++i.E;
    if (c == b) {
      ++i.F;
    } else if (c != a) {  // labels a, b, a: counted from w
      facets.push_back({{a, b, c}, {v, u, w}});
    }
  }
  if (!on_boundary) return;
  ++r.boundary_V;
  // A boundary edge has only one direction, from the previous vertex to v.
  const SiteId before = label[ring.back()], next = label[ring.front()];
  if (before == a) {
    ++r.boundary_E;
  } else {
    Interface& i = interface_with(before);
    ++i.E;
    ++i.boundary_E;
  }
  if (next != a) ++interface_with(next).boundary_E;
}

Verdict Certificate::check(SiteId a, ContourId at, std::vector<DualFacet>& facets) {
  using paper::Reason;
  const Region r = count_region(a, at, facets);
  const std::span<const ContourId> all = labels_.region(a);
  const ContourMesh& contour = labels_.contour();
  const auto furthest_if = [&](auto&& is_meant) {
    ContourId furthest = kNoId;
    for (const ContourId v : all) {
      if (is_meant(v)) furthest = labels_.further(furthest, v);
    }
    return furthest;
  };
  // C1
  if (r.V != static_cast<long>(all.size())) {
    return {Reason::region, furthest_if([&](ContourId v) { return visited_[v] != checks_; })};
  }
  if (r.V - r.E + r.F != 1) return {Reason::region, labels_.furthest(all)};
  // C4
  if (r.boundary_V > 0 && (!contour.on_boundary(at) || r.boundary_V - r.boundary_E != 1)) {
    return {Reason::boundary, furthest_if([&](ContourId v) { return contour.on_boundary(v); })};
  }
  for (const Interface& i : interfaces_) {
    if (i.boundary_E > 1) return {Reason::boundary, furthest_between(a, i.site)};  // C4
    if (i.E - i.F != 1) return {Reason::interface, furthest_between(a, i.site)};   // C2
  }
  // C3
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
