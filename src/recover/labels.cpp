// SPDX-License-Identifier: MIT
#include "recover/labels.h"

#include <algorithm>
#include <utility>

#include "base/sorted_list.h"

namespace deliso {
namespace {

// Triangle inequality: a site s' with |ps'| < |ps| has |ss'| < 2 |ps|. This is the factor squared,
// with a margin for rounding.
constexpr double kMaxDistanceRatio2 = 4 * (1 + 1e-12);

using Neighbor = std::pair<double, SiteId>;  // squared distance, site

// Returns the Delaunay neighbors of every finite vertex, the nearest first.
std::vector<std::vector<Neighbor>> neighbors_of_all(const Triangulation& t) {
  std::vector<std::vector<Neighbor>> all(t.vertex_capacity());
  for (CellId c = 0; c < t.cell_capacity(); ++c) {
    if (!t.is_live(c)) continue;
    for (const SiteId v : t.vertices(c)) {
      for (const SiteId n : t.vertices(c)) {
        if (n == v || n == Triangulation::kInfinite || v == Triangulation::kInfinite) continue;
        all[v].emplace_back(distance2(t.point(v), t.point(n)), n);
      }
    }
  }
  for (std::vector<Neighbor>& neighbors : all) sort_unique(neighbors);
  return all;
}

}  // namespace

ContourGraph::ContourGraph(const ContourMesh& contour) : first_(contour.points.size() + 1, 0) {
  // A triangle (v, next, previous) seen from its vertex v.
  struct Wedge {
    ContourId next, previous;
  };
  for (const auto& t : contour.triangles) {
    for (const ContourId v : t) ++first_[v + 1];
  }
  for (ContourId v = 0; v < contour.points.size(); ++v) {
    first_[v + 1] += first_[v] + contour.on_boundary(v);  // has one neighbor more than triangles
  }
  std::vector<Wedge> wedges(first_.back());
  std::vector<std::uint32_t> end(first_.begin(), first_.end() - 1);
  for (const auto& t : contour.triangles) {
    for (std::size_t i = 0; i < 3; ++i) wedges[end[t[i]]++] = {t[(i + 1) % 3], t[(i + 2) % 3]};
  }
  rings_.resize(first_.back());
  for (ContourId v = 0; v < contour.points.size(); ++v) {
    const std::span<Wedge> at = std::span(wedges).subspan(first_[v], end[v] - first_[v]);
    ContourId* ring = rings_.data() + first_[v];
    // A boundary ring begins at the triangle with no triangle before it.
    const auto begins = [&](const Wedge& w) {
      return std::ranges::find(at, w.next, &Wedge::previous) == at.end();
    };
    ContourId next = contour.on_boundary(v) ? std::ranges::find_if(at, begins)->next : at[0].next;
    for (std::size_t k = 0; k < at.size(); ++k) {
      std::size_t found = k;
      while (found + 1 < at.size() && at[found].next != next) ++found;
      std::swap(at[k], at[found]);
      *ring++ = next;
      next = at[k].previous;
    }
    if (contour.on_boundary(v)) *ring = next;
  }
}

Labels::Labels(const ContourMesh& contour, const Triangulation& t)
    : contour_(contour),
      triangulation_(t),
      graph_(contour),
      label_(contour.points.size(), kNoId),
      distance2_(contour.points.size()),
      regions_(t.vertex_capacity()),
      radius2_(t.vertex_capacity(), 0) {
  const std::vector<std::vector<Neighbor>> neighbors = neighbors_of_all(t);
  SiteId site = 1;
  for (ContourId v = 0; v < label_.size(); ++v) {
    const Vec3& p = contour.points[v];
    double best2 = distance2(p, t.point(site));
    for (SiteId from = kNoId; from != site;) {
      from = site;
      const double furthest2 = kMaxDistanceRatio2 * best2;
      for (const auto& [between2, n] : neighbors[from]) {
        if (between2 > furthest2) break;
        const double d2 = distance2(p, t.point(n));
        // Of equally near ones the smallest id; `from` before all.
        if (d2 > best2 || (d2 == best2 && (site == from || n > site))) continue;
        best2 = d2;
        site = n;
      }
    }
    label_[v] = site;
    distance2_[v] = best2;
    regions_[site].push_back(v);
    radius2_[site] = std::max(radius2_[site], best2);
  }
}

std::vector<SiteId> Labels::add_site(SiteId site, std::span<const SiteId> neighbors) {
  std::vector<SiteId> changed;
  regions_.resize(std::max<std::size_t>(regions_.size(), site + 1));
  radius2_.resize(regions_.size(), 0);
  const Vec3 point = triangulation_.point(site);
  std::vector<ContourId> own;
  double radius2 = 0;
  for (const SiteId n : neighbors) {
    if (distance2(point, triangulation_.point(n)) > kMaxDistanceRatio2 * radius2_[n]) continue;
    std::vector<ContourId>& region = regions_[n];
    const auto kept = std::remove_if(region.begin(), region.end(), [&](ContourId v) {
      const double d2 = distance2(contour_.points[v], point);
      if (d2 >= distance2_[v]) return false;
      distance2_[v] = d2;
      label_[v] = site;
      own.push_back(v);
      radius2 = std::max(radius2, d2);
      return true;
    });
    if (kept == region.end()) continue;
    region.erase(kept, region.end());
    changed.push_back(n);
  }
  regions_[site] = std::move(own);
  radius2_[site] = radius2;
  return changed;
}

}  // namespace deliso
