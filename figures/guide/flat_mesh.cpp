// SPDX-License-Identifier: MIT
#include "guide/flat_mesh.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/triangle.h"
#include "delaunay/triangulation.h"
#include "recover/certificate.h"
#include "recover/labels.h"
#include "surface/surface_point.h"

namespace deliso::guide {

FlatContour::FlatContour(const Slice& slice) : contour_(build_contour(slice.volume(), 0)) {
  for (std::size_t c = 0; c < contour_.boundary.size(); ++c) {
    const auto& chain = contour_.boundary.vertices[c];
    if (contour_.points[chain[0]].z != 0) continue;
    loops_.emplace_back();
    for (const VertexId v : chain) {
      loops_.back().push_back(points_.size());
      lower_.push_back(v);
      points_.push_back({contour_.points[v].x, contour_.points[v].y});
    }
  }
  for (const Vec2& p : points_) {
    const Vec3 above{p.x, p.y, Slice::kLayers};
    const auto found = std::find(contour_.points.begin(), contour_.points.end(), above);
    DELISO_CHECK(found != contour_.points.end());
    upper_.push_back(VertexId(found - contour_.points.begin()));
  }
}

std::size_t FlatContour::nearest_vertex(const Vec2& p) const {
  return static_cast<std::size_t>(std::min_element(points_.begin(), points_.end(),
                                                   [&](const Vec2& a, const Vec2& b) {
                                                     return distance2(a, p) < distance2(b, p);
                                                   }) -
                                  points_.begin());
}

FlatContour::Regions FlatContour::regions(const std::vector<std::size_t>& sites) const {
  std::vector<Vec3> places;
  for (const std::size_t s : sites) places.push_back(contour_.points[lower_[s]]);
  for (const std::size_t s : sites) places.push_back(contour_.points[upper_[s]]);
  Triangulation triangulation;
  std::vector<SiteId> ids;
  DELISO_CHECK(triangulation.build(places, ids));
  const Labels labels(contour_, triangulation);
  Regions out;
  for (const VertexId v : lower_) {
    const auto site = std::find(ids.begin(), ids.end(), labels.label(v)) - ids.begin();
    out.site_of.push_back(sites[static_cast<std::size_t>(site)]);
  }
  for (const auto& loop : loops_) {
    for (std::size_t n = 0; n < loop.size(); ++n) {
      const std::size_t a = out.site_of[loop[n]], b = out.site_of[loop[(n + 1) % loop.size()]];
      if (a != b) out.dual.push_back({a, b});
    }
  }
  Certificate certificate(labels);
  std::vector<DualFacet> facets;
  for (std::size_t n = 0; n < sites.size() && !out.violation; ++n) {
    const Verdict verdict = certificate.check(ids[n], lower_[sites[n]], facets);
    if (!verdict.violation) continue;
    const Vec3& p = contour_.points[verdict.insert];
    out.violation = Violation{sites[n], nearest_vertex({p.x, p.y})};
  }
  return out;
}

FlatFacet FlatMesh::facet(std::size_t n) const {
  const Vec2 a = loop_[n], b = loop_[(n + 1) % loop_.size()];
  // Upright, seen from the right of the way from a to b.
  const Vec3 top{0.5 * (a.x + b.x), 0.5 * (a.y + b.y), Slice::kLayers};
  const Vec3 p{a.x, a.y, 0}, q{b.x, b.y, 0};
  SearchCounters counters;
  const auto found = SurfacePointFinder(slice_.surface()).find(p, q, top, counters);
  DELISO_CHECK(found.has_value());
  const Vec2 center = 0.5 * (a + b), x{found->x, found->y};
  return {a, b, center, x, std::sqrt(distance2(center, x)), std::sqrt(distance2(a, x))};
}

std::size_t FlatMesh::worst() const {
  std::size_t worst = 0;
  for (std::size_t n = 1; n < loop_.size(); ++n) {
    if (facet(n).h > facet(worst).h) worst = n;
  }
  return worst;
}

void FlatMesh::insert(std::size_t n) {
  const Vec2 p = facet(n).x;
  for (std::size_t other = 0; other < loop_.size(); ++other) {
    const FlatFacet f = facet(other);
    DELISO_CHECK(other == n || distance2(f.x, p) >= f.radius * f.radius);
  }
  loop_.insert(loop_.begin() + static_cast<std::ptrdiff_t>(n) + 1, p);
}

}  // namespace deliso::guide
