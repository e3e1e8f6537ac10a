// SPDX-License-Identifier: MIT
#include "recover/certificate.h"

namespace deliso {

Certificate::Scratch::Interface& Certificate::Scratch::interface_with(VertexId site) {
  for (Interface& i : interfaces) {
    if (i.site == site) return i;
  }
  interfaces.push_back({site});
  return interfaces.back();
}

Verdict Certificate::check(VertexId a, VertexId at, Scratch& scratch,
                           std::vector<DualFacet>& facets) {
  using Interface = Scratch::Interface;
  const auto interface_with = [&](VertexId site) -> Interface& {
    return scratch.interface_with(site);
  };
  scratch.interfaces.clear();
  facets.clear();
  long directed = 0, thrice_faces = 0;
  long boundary_vertices = 0, boundary_edges = 0;
  VertexId furthest_boundary = kNoId;

  // One pass over what is connected to the site's own vertex.
  std::vector<VertexId>& reached = scratch.reached;
  reached.assign(1, at);
  visited_[at] = round_;
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const VertexId v = reached[k];
    const VertexId next = graph_.chain_next(v);
    const auto reach = [&](VertexId u) {
      if (labels_.label(u) != a || visited_[u] == round_) return;
      visited_[u] = round_;
      reached.push_back(u);
    };
    // Around an inner vertex, every neighbour comes next in some triangle.
    if (next != kNoId) reach(graph_.chain_previous(v));
    for (const ContourGraph::Wedge& w : graph_.wedges(v)) {
      const VertexId x = labels_.label(w.next), y = labels_.label(w.previous);
      // The directed edge v -> next: an inner edge turns up from both its ends.
      if (x == a) {
        ++directed;
      } else {
        Interface& i = interface_with(x);
        ++i.edges;
        i.furthest = labels_.further(labels_.further(i.furthest, v), w.next);
      }
      reach(w.next);
      // The triangle: seen once from each of its vertices labelled a.
      if (x == a && y == a) {
        ++thrice_faces;
      } else if (x == a || y == a) {
        interface_with(x == a ? y : x).twice_faces += 1;
      } else if (x == y) {
        interface_with(x).twice_faces += 2;
      } else {
        facets.push_back({{a, x, y}, {v, w.next, w.previous}});
      }
    }
    if (next == kNoId) continue;
    ++boundary_vertices;
    furthest_boundary = labels_.further(furthest_boundary, v);
    // A boundary edge runs one way only, from the vertex before.
    const VertexId before = graph_.chain_previous(v);
    if (labels_.label(before) == a) {
      ++boundary_edges;
    } else {
      Interface& i = interface_with(labels_.label(before));
      ++i.edges;
      ++i.boundary_edges;
      i.furthest = labels_.further(labels_.further(i.furthest, v), before);
    }
    if (labels_.label(next) != a) ++interface_with(labels_.label(next)).boundary_edges;
  }

  const std::span<const VertexId> region = labels_.region(a);
  if (reached.size() != region.size()) {
    VertexId stray = kNoId;
    for (const VertexId v : region) {
      if (visited_[v] != round_) stray = labels_.further(stray, v);
    }
    return {Violation::region, stray};
  }
  const long vertices = static_cast<long>(region.size());
  const long edges = (directed + boundary_edges) / 2;
  if (vertices - edges + thrice_faces / 3 != 1) {
    VertexId furthest = kNoId;
    for (const VertexId v : region) furthest = labels_.further(furthest, v);
    return {Violation::region, furthest};
  }
  if (boundary_vertices > 0) {
    const bool boundary_site = graph_.chain_next(at) != kNoId;
    if (!boundary_site || boundary_vertices - boundary_edges != 1) {
      return {Violation::boundary, furthest_boundary};
    }
  }
  for (const Interface& i : scratch.interfaces) {
    if (i.boundary_edges > 1) return {Violation::boundary, i.furthest};
    if (2 * i.edges - i.twice_faces != 2) return {Violation::interface, i.furthest};
  }
  for (std::size_t i = 0; i < facets.size(); ++i) {
    for (std::size_t j = i + 1; j < facets.size(); ++j) {
      const auto &s = facets[i].sites, &t = facets[j].sites;
      const bool same = (s[1] == t[1] && s[2] == t[2]) || (s[1] == t[2] && s[2] == t[1]);
      if (!same) continue;
      VertexId best = kNoId;
      for (const VertexId v : facets[i].witness) best = labels_.further(best, v);
      for (const VertexId v : facets[j].witness) best = labels_.further(best, v);
      return {Violation::triple, best};
    }
  }
  return {};
}

}  // namespace deliso
