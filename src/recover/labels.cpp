// SPDX-License-Identifier: MIT
#include "recover/labels.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "base/sorted_list.h"

namespace deliso {
namespace {

// What is nearer than a site is no further from it than twice its distance: squared, and a little
// more for rounding.
constexpr double kTwice2 = 4 * (1 + 1e-12);

// Delaunay neighbours of every finite vertex, the nearest first, in one array.
struct SiteGraph {
  struct Neighbor {
    double distance2;
    VertexId vertex;
  };
  std::vector<std::uint32_t> first;
  std::vector<Neighbor> neighbors;

  explicit SiteGraph(const Triangulation& t) : first(t.vertex_capacity() + 1, 0) {
    std::vector<std::uint64_t> edges;
    for (CellId c = 0; c < t.cell_capacity(); ++c) {
      if (!t.is_live(c)) continue;
      for (const VertexId a : t.vertices(c)) {
        for (const VertexId b : t.vertices(c)) {
          if (a == b || a == Triangulation::kInfinite || b == Triangulation::kInfinite) continue;
          edges.push_back(std::uint64_t{a} << 32 | b);
        }
      }
    }
    sort_out(edges);
    for (const std::uint64_t e : edges) {
      ++first[(e >> 32) + 1];
      const auto from = static_cast<VertexId>(e >> 32), to = static_cast<VertexId>(e);
      neighbors.push_back({distance2(t.point(from), t.point(to)), to});
    }
    for (std::size_t v = 1; v < first.size(); ++v) {
      first[v] += first[v - 1];
      std::sort(neighbors.begin() + first[v - 1], neighbors.begin() + first[v],
                [](const Neighbor& a, const Neighbor& b) {
                  return std::tie(a.distance2, a.vertex) < std::tie(b.distance2, b.vertex);
                });
    }
  }
};

}  // namespace

ContourGraph::ContourGraph(const ContourMesh& contour)
    : first_(contour.points.size() + 1, 0),
      wedges_(3 * contour.triangles.size()),
      slot_(contour.points.size(), kNoId) {
  for (const auto& t : contour.triangles) {
    for (const VertexId v : t) ++first_[v + 1];
  }
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const auto& t : contour.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      wedges_[next[t[i]]++] = {t[(i + 1) % 3], t[(i + 2) % 3]};
    }
  }
  for (std::uint32_t c = 0; c < contour.boundary.size(); ++c) {
    const std::span<const VertexId> chain = contour.boundary.chain(c);
    const std::size_t n = chain.size();
    for (std::size_t k = 0; k < n; ++k) {
      slot_[chain[k]] = static_cast<std::uint32_t>(next_.size());
      next_.push_back(chain[(k + 1) % n]);
      previous_.push_back(chain[(k + n - 1) % n]);
      place_.push_back({c, static_cast<double>(k)});
    }
  }
}

Labels::Labels(const ContourMesh& contour, const ContourGraph& graph, const Triangulation& t,
               std::span<const std::uint8_t> kept)
    : contour_(contour),
      label_(contour.points.size(), kNoId),
      distance2_(contour.points.size()),
      regions_(t.vertex_capacity()) {
  const SiteGraph sites(t);
  std::vector<VertexId> pending;
  for (VertexId start = 0; start < label_.size(); ++start) {
    if (label_[start] != kNoId || !kept[contour.component[start]]) continue;
    label_[start] = start > 0 && label_[start - 1] != kNoId ? label_[start - 1] : 1;
    pending.assign(1, start);
    while (!pending.empty()) {
      const VertexId v = pending.back();
      pending.pop_back();
      const Vec3& p = contour.points[v];
      VertexId site = label_[v];
      double best2 = distance2(p, t.point(site));
      for (bool moved = true; moved;) {
        moved = false;
        const VertexId from = site;
        const double from2 = best2;
        for (std::uint32_t k = sites.first[from]; k < sites.first[from + 1]; ++k) {
          const SiteGraph::Neighbor& n = sites.neighbors[k];
          if (n.distance2 > kTwice2 * from2) break;  // and so are the rest: none is nearer
          const double d2 = distance2(p, t.point(n.vertex));
          if (d2 >= best2) continue;
          best2 = d2;
          site = n.vertex;
          moved = true;
        }
      }
      label_[v] = site;
      distance2_[v] = best2;
      for (const ContourGraph::Wedge& w : graph.wedges(v)) {
        for (const VertexId u : {w.next, w.previous}) {
          if (label_[u] != kNoId) continue;
          label_[u] = site;
          pending.push_back(u);
        }
      }
    }
  }
  for (VertexId v = 0; v < label_.size(); ++v) {
    if (label_[v] != kNoId) regions_[label_[v]].push_back(v);
  }
}

void Labels::add_site(VertexId site, const Vec3& point, std::span<const VertexId> neighbors,
                      std::vector<VertexId>& changed) {
  regions_.resize(std::max<std::size_t>(regions_.size(), site + 1));
  std::vector<VertexId> taken;
  for (const VertexId n : neighbors) {
    std::vector<VertexId>& region = regions_[n];
    const auto kept = std::remove_if(region.begin(), region.end(), [&](VertexId v) {
      const double d2 = distance2(contour_.points[v], point);
      if (d2 >= distance2_[v]) return false;
      distance2_[v] = d2;
      label_[v] = site;
      taken.push_back(v);
      return true;
    });
    if (kept == region.end()) continue;
    region.erase(kept, region.end());
    changed.push_back(n);
  }
  regions_[site] = std::move(taken);
}

}  // namespace deliso
