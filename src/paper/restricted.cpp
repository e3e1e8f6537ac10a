// SPDX-License-Identifier: MIT
#include "paper/restricted.h"

#include <algorithm>

#include "base/check.h"
#include "base/sorted_list.h"

namespace deliso {

RestrictedDelaunay::RestrictedDelaunay(const Isosurface& surface, Triangulation triangulation,
                                       double delta, Report& report, Observer* follower)
    : surface_(surface),
      triangulation_(std::move(triangulation)),
      delta_(delta),
      report_(report),
      follower_(follower),
      box_(surface.volume().box()) {
  const Triangulation& t = triangulation_;
  record_of_.assign(4 * t.cell_capacity(), kNoId);
  for (CellId c = 0; c < t.cell_capacity(); ++c) {
    if (!t.is_live(c)) continue;
    for (int i = 0; i < 4; ++i) {
      if (c < t.neighbor(c, i)) search({c, i});
    }
  }
  if (follower_) follower_->restricted_ready(*this);
}

void RestrictedDelaunay::search(Facet f) {
  const Triangulation& t = triangulation_;
  if (has_infinite_vertex(t, f)) return;
  const FacetDual dual = facet_dual(t, f);
  const Range range = clip(dual.center, dual.normal, {dual.t_lo, dual.t_hi}, box_);
  if (range.empty()) return;
  const Segment edge{dual.center + range.lo * dual.normal, dual.center + range.hi * dual.normal};
  surface_.intersect(edge, found_, report_.searches_recover);
  if (found_.empty()) return;

  RecordId r;
  if (free_records_.empty()) {
    r = static_cast<RecordId>(records_.size());
    records_.emplace_back();
  } else {
    r = free_records_.back();
    free_records_.pop_back();
  }
  records_[r].facet = f;
  for (const Hit& hit : found_) records_[r].hits.push_back(hit.point);
  record_slot(f) = r;
  record_slot(t.mirror(f)) = r;
  created_records_.push_back(r);
  touch(f);
}

void RestrictedDelaunay::release(RecordId r, Facet f) {
  if (follower_) follower_->record_gone(r);
  record_slot(f) = kNoId;
  record_slot(triangulation_.mirror(f)) = kNoId;
  records_[r].hits.clear();
  ++records_[r].generation;
  free_records_.push_back(r);
}

void RestrictedDelaunay::forget(RecordId r) {
  release(r, records_[r].facet);
  ++report_[Counter::bogus_hits];
}

std::span<const Vec3> RestrictedDelaunay::effective_hits(RecordId r) const {
  const std::vector<Vec3>& hits = records_[r].hits;
  if (hits.size() < 2) return hits;
  effective_.clear();
  for (const Vec3& x : hits) {
    if (!effective_.empty() && distance2(effective_.back(), x) < delta_ * delta_) {
      effective_.pop_back();
    } else {
      effective_.push_back(x);
    }
  }
  return effective_;
}

Vec3 RestrictedDelaunay::surface_point(RecordId r) const {
  const std::span<const Vec3> hits = effective_hits(r);
  if (hits.size() == 1) return hits[0];
  const SiteTriangle v = triangle(r);
  // Along the Voronoi edge the distance to a corner grows with the distance to the circumcenter.
  const Vec3& a = triangulation_.point(v[0]);
  return *std::min_element(hits.begin(), hits.end(), [&](const Vec3& x, const Vec3& y) {
    return distance2(x, a) < distance2(y, a);
  });
}

void RestrictedDelaunay::gather_cells(SiteId q) const {
  const Triangulation& t = triangulation_;
  cell_stamp_.resize(t.cell_capacity(), 0);
  ++around_stamp_;
  around_.assign(1, t.incident_cell(q));
  cell_stamp_[around_[0]] = around_stamp_;
  for (std::size_t next = 0; next < around_.size(); ++next) {
    const CellId c = around_[next];
    for (int i = 0; i < 4; ++i) {
      const CellId d = t.neighbor(c, i);
      if (t.vertex(c, i) == q || cell_stamp_[d] == around_stamp_) continue;
      cell_stamp_[d] = around_stamp_;
      around_.push_back(d);
    }
  }
}

void RestrictedDelaunay::star(SiteId q, std::vector<RecordId>& star) const {
  const Triangulation& t = triangulation_;
  star.clear();
  gather_cells(q);
  for (const CellId c : around_) {
    for (int i = 0; i < 4; ++i) {
      const RecordId r = record({c, i});
      if (r == kNoId || t.vertex(c, i) == q || c > t.neighbor(c, i)) continue;
      if (is_restricted(r)) star.push_back(r);
    }
  }
}

std::vector<SiteId> RestrictedDelaunay::neighbors(SiteId q) const {
  gather_cells(q);
  std::vector<SiteId> neighbors;
  for (const CellId c : around_) {
    for (const SiteId v : triangulation_.vertices(c)) {
      if (v != q && v != Triangulation::kInfinite) neighbors.push_back(v);
    }
  }
  sort_unique(neighbors);
  return neighbors;
}

const ConflictZone& RestrictedDelaunay::prepare(const Vec3& p, CellId hint) {
  triangulation_.find_conflicts(p, hint, zone_);
  return zone_;
}

double RestrictedDelaunay::distance_to_vertices(const Vec3& p) {
  double nearest2 = std::numeric_limits<double>::infinity();
  for (const CellId c : zone_.cells) {
    for (const SiteId v : triangulation_.vertices(c)) {
      if (v == Triangulation::kInfinite) continue;
      nearest2 = std::min(nearest2, distance2(p, triangulation_.point(v)));
    }
  }
  return std::sqrt(nearest2);
}

void RestrictedDelaunay::touch(Facet f) {
  const SiteTriangle v = facet_vertices(triangulation_, f);
  touched_.insert(touched_.end(), v.begin(), v.end());
}

SiteId RestrictedDelaunay::insert_prepared(const Vec3& p) {
  DELISO_ASSERT(!zone_.cells.empty());
  Triangulation& t = triangulation_;
  touched_.assign(1, SiteId(t.vertex_capacity()));
  created_records_.clear();
  if (follower_) follower_->insertion_begins(p, zone_);

  // Facets on the zone's boundary survive with their records; all other records of the zone are
  // released.
  surviving_.clear();
  for (const Facet f : zone_.boundary) {
    surviving_.push_back(record_slot(f));
    record_slot(f) = kNoId;
  }

  for (const CellId c : zone_.cells) {
    for (int i = 0; i < 4; ++i) {
      const RecordId r = record_slot({c, i});
      if (r == kNoId) continue;
      touch({c, i});
      release(r, {c, i});
    }
  }

  const SiteId v = t.insert_in_zone(p, zone_, created_cells_);
  record_of_.resize(4 * t.cell_capacity(), kNoId);

  for (std::size_t k = 0; k < created_cells_.size(); ++k) {
    const RecordId r = surviving_[k];
    if (r == kNoId) continue;
    const Facet f{created_cells_[k], zone_.boundary[k].index};
    record_slot(f) = r;
    records_[r].facet = f;
    // A hit stays on the Voronoi edge if it is not nearer to p than to the facet's corners.
    std::vector<Vec3>& hits = records_[r].hits;
    const Vec3& a = t.point(facet_vertices(t, f)[0]);
    const auto lost = std::remove_if(
        hits.begin(), hits.end(), [&](const Vec3& x) { return distance2(x, p) < distance2(x, a); });
    if (lost == hits.end()) continue;
    hits.erase(lost, hits.end());
    touch(f);
    if (hits.empty()) {
      release(r, f);
    } else {
      created_records_.push_back(r);
    }
  }
  for (std::size_t k = 0; k < created_cells_.size(); ++k) {
    const CellId c = created_cells_[k];
    for (int i = 0; i < 4; ++i) {
      if (i != zone_.boundary[k].index && c < t.neighbor(c, i)) search({c, i});
    }
  }
  if (follower_) follower_->site_added(v);
  return v;
}

}  // namespace deliso
