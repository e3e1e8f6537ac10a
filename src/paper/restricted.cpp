// SPDX-License-Identifier: MIT
#include "paper/restricted.h"

#include <algorithm>
#include <utility>

#include "delaunay/voronoi.h"

namespace deliso::paper {

RestrictedDelaunay::RestrictedDelaunay(Triangulation del, Sigma& sigma, const Options& options,
                                       Report& report)
    : del_(std::move(del)),
      sigma_(sigma),
      options_(options),
      report_(report),
      box_(sigma.volume().box()),
      hits_(4 * del_.cell_capacity()) {
  for_each_facet(del_, [&](Facet f) { search(f); });
}

std::size_t RestrictedDelaunay::slot(Facet f) const {
  const Facet g = del_.mirror(f);
  return f.cell < g.cell ? 4 * std::size_t{f.cell} + static_cast<std::size_t>(f.index)
                         : 4 * std::size_t{g.cell} + static_cast<std::size_t>(g.index);
}

std::optional<Segment> RestrictedDelaunay::voronoi_edge(Facet sigma) const {
  if (has_infinite_vertex(del_, sigma)) return {};
  const FacetDual edge = facet_dual(del_, sigma);
  const Range t = clip(edge.center, edge.normal, {edge.t_lo, edge.t_hi}, box_);
  if (!(t.lo < t.hi)) return {};
  return Segment{edge.at(t.lo), edge.at(t.hi)};
}

void RestrictedDelaunay::search(Facet f) {
  const std::optional<Segment> edge = voronoi_edge(f);
  if (!edge) return;
  std::vector<Hit>& x = hits_[slot(f)];
  for (const Hit& hit : sigma_.intersect(*edge, report_.searches_recover)) {
    if (!x.empty() && distance(x.back().point, hit.point) < Options::kClosest * report_.r_min) {
      x.pop_back();
      ++report_.cancelled_pairs;
    } else {
      x.push_back(hit);
    }
  }
  if (x.empty()) return;
  created_.push_back(f);
  add_touched(f);
}

void RestrictedDelaunay::add_touched(Facet f) {
  const SiteTriangle v = facet_vertices(del_, f);
  touched_.insert(touched_.end(), v.begin(), v.end());
}

std::span<const CellId> RestrictedDelaunay::cells_at(SiteId q) const {
  seen_.resize(del_.cell_capacity(), 0);
  around_.assign(1, del_.incident_cell(q));
  seen_[around_[0]] = ++round_;
  for (std::size_t n = 0; n < around_.size(); ++n) {
    const CellId c = around_[n];
    for (int i = 0; i < 4; ++i) {
      if (del_.vertex(c, i) == q) continue;
      const CellId d = del_.neighbor(c, i);
      if (seen_[d] != round_) {
        seen_[d] = round_;
        around_.push_back(d);
      }
    }
  }
  return around_;
}

void RestrictedDelaunay::star(SiteId q, std::vector<Facet>& d_q) const {
  d_q.clear();
  for (const CellId c : cells_at(q)) {
    for (int i = 0; i < 4; ++i) {
      if (del_.vertex(c, i) == q || !(c < del_.neighbor(c, i))) continue;
      if (!hits({c, i}).empty()) d_q.push_back({c, i});
    }
  }
}

const ConflictZone& RestrictedDelaunay::find_conflicts(const Vec3& p, CellId hint) {
  del_.find_conflicts(p, hint, zone_);
  return zone_;
}

SiteId RestrictedDelaunay::insert(const Vec3& p) {
  if (options_.observer) options_.observer->insertion_begins(p, zone_);
  created_.clear();
  touched_.assign(1, SiteId(del_.vertex_capacity()));
  for (const CellId c : zone_.cells) {
    for (int i = 0; i < 4; ++i) {
      std::vector<Hit>& x = hits_[slot({c, i})];
      if (!x.empty()) add_touched({c, i});
      x.clear();
    }
  }
  const SiteId v = del_.insert_in_zone(p, zone_, new_cells_);
  hits_.resize(4 * del_.cell_capacity());
  // A new facet of the zone's boundary is searched, though it was there before.
  for (std::size_t k = 0; k < new_cells_.size(); ++k) {
    const CellId c = new_cells_[k];
    for (int i = 0; i < 4; ++i) {
      if (i == zone_.boundary[k].index || c < del_.neighbor(c, i)) search({c, i});
    }
  }
  if (options_.observer) options_.observer->site_added(v);
  return v;
}

Violation violation(const FacetShape& m, double epsilon, double pole, const Options& options) {
  return std::max({Violation{m.h / m.r / epsilon, Reason::h_over_r},
                   Violation{m.r / m.l / options.lambda, Reason::r_over_l},
                   Violation{m.r / pole / options.epsilon2, Reason::r_over_pole}},
                  [](const Violation& a, const Violation& b) { return a.value < b.value; });
}

SiteTriangle turned(SiteTriangle corners, const Hit& x) {
  // The dual line sees the corners turn counter-clockwise from the lowest to the highest.
  std::ranges::sort(corners);
  if (!x.leaves) std::swap(corners[1], corners[2]);
  return corners;
}

}  // namespace deliso::paper
