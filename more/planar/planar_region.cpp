// SPDX-License-Identifier: MIT
#include "more/planar/planar_region.h"

#include <algorithm>
#include <cmath>

#include "more/planar/plane_predicates.h"

namespace deliso {

bool mark_inside(ConstrainedTriangulation& triangulation, bool default_inside) {
  const std::size_t count = triangulation.triangles().size();
  std::vector<bool> seen(count, false);
  std::vector<FaceId> piece;
  for (FaceId start = 0; start < count; ++start) {
    if (seen[start]) continue;
    seen[start] = true;
    piece.assign(1, start);
    bool inside = false, outside = false;
    for (std::size_t n = 0; n < piece.size(); ++n) {
      const PlaneTriangle& t = triangulation.triangle(piece[n]);
      for (int i = 0; i < 3; ++i) {
        inside |= t.side[i] == Side::inside;
        outside |= t.side[i] == Side::outside;
        if (t.side[i] != Side::none || t.n[i] == kNoId || seen[t.n[i]]) continue;
        seen[t.n[i]] = true;
        piece.push_back(t.n[i]);
      }
    }
    if (inside && outside) return false;
    if (!inside && !outside) inside = default_inside;
    for (const FaceId t : piece) triangulation.triangle(t).inside = inside;
  }
  return true;
}

namespace {

// A share of the rectangle's diagonal. Smaller triangles have circumcenters so rounded that r/l may
// never fall.
constexpr double kMinRadiusShare = 0x1p-40;

Vec2 circumcenter(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = b - a, v = c - a;
  const double d = 2 * (u.x * v.y - u.y * v.x), uu = dot(u, u), vv = dot(v, v);
  return a + Vec2{(v.y * uu - u.y * vv) / d, (u.x * vv - v.x * uu) / d};
}

}  // namespace

RegionRefiner::RegionRefiner(ConstrainedTriangulation& triangulation, double lambda)
    : triangulation_(triangulation),
      lambda2_(lambda * lambda),
      min_radius2_(kMinRadiusShare * kMinRadiusShare *
                   distance2(triangulation.point(0), triangulation.point(2))) {
  for (FaceId t = 0; t < triangulation.triangles().size(); ++t) enqueue_if_bad(t);
}

bool RegionRefiner::in_circle_about(FaceId t, int i, const Vec2& p) const {
  const auto& v = triangulation_.triangle(t).v;
  return dot(triangulation_.point(v[(i + 1) % 3]) - p, triangulation_.point(v[(i + 2) % 3]) - p) <
         0;
}

bool RegionRefiner::is_kept(VertexId a, VertexId b) const {
  return std::find(kept_sides_.begin(), kept_sides_.end(), std::pair{a, b}) != kept_sides_.end();
}

bool RegionRefiner::request_split(FaceId t, int i) {
  const PlaneTriangle& at = triangulation_.triangle(t);
  const std::pair side{at.v[(i + 1) % 3], at.v[(i + 2) % 3]};
  if (at.side[i] != Side::none || is_kept(side.first, side.second)) return false;
  if (std::find(requested_sides_.begin(), requested_sides_.end(), side) == requested_sides_.end())
    requested_sides_.push_back(side);
  return true;
}

void RegionRefiner::enqueue_if_bad(FaceId t) {
  const PlaneTriangle& at = triangulation_.triangle(t);
  if (!at.inside) return;
  for (int i = 0; i < 3; ++i) {
    if (is_side(t, i) && in_circle_about(t, i, triangulation_.point(at.v[i]))) request_split(t, i);
  }
  const Vec2 &a = triangulation_.point(at.v[0]), &b = triangulation_.point(at.v[1]),
             &c = triangulation_.point(at.v[2]);
  const double shortest2 = std::min({distance2(a, b), distance2(b, c), distance2(c, a)});
  const double r2 = distance2(circumcenter(a, b, c), a), ratio2 = r2 / shortest2;
  if (ratio2 <= lambda2_) return;
  if (r2 < min_radius2_) {  // unreachable: by loops of our own meshes
    ++refused_;
    return;
  }
  queue_.push_back({ratio2, t, at.v});
  std::push_heap(queue_.begin(), queue_.end());
}

void RegionRefiner::enqueue_bad_around(VertexId v) {
  cavity_.clear();
  triangulation_.circulate(v, [&](FaceId t, int) {
    cavity_.push_back(t);
    return true;
  });
  for (const FaceId t : cavity_) enqueue_if_bad(t);
}

void RegionRefiner::add_split(VertexId v) {
  enqueue_bad_around(v);
}

void RegionRefiner::run(std::vector<std::pair<VertexId, VertexId>>& sides) {
  for (const Bad& bad : std::exchange(waiting_, {})) {
    queue_.push_back(bad);
    std::push_heap(queue_.begin(), queue_.end());
  }
  while (!queue_.empty()) {
    std::pop_heap(queue_.begin(), queue_.end());
    const Bad bad = queue_.back();
    queue_.pop_back();
    if (triangulation_.triangle(bad.t).v == bad.v) refine(bad);
  }
  for (const auto& [a, b] : std::exchange(requested_sides_, {})) {
    const PlaneEdge e = triangulation_.find_edge(a, b);
    if (e.t != kNoId && is_side(e.t, e.i) && !is_kept(a, b)) sides.emplace_back(a, b);
  }
}

void RegionRefiner::refine(const Bad& bad) {
  const Vec2 p = circumcenter(triangulation_.point(bad.v[0]), triangulation_.point(bad.v[1]),
                              triangulation_.point(bad.v[2]));
  if (!std::isfinite(p.x) || !std::isfinite(p.y)) {  // unreachable: r is finite
    ++refused_;
    return;
  }
  const auto place = triangulation_.locate(p, bad.t);
  if (place.t == kNoId) {
    if (place.blocked && request_split(place.blocked->t, place.blocked->i)) {
      waiting_.push_back(bad);
    } else {
      ++refused_;
    }
    return;
  }
  // The cavity of p: the triangles whose circumcircles hold p. Segments and sides bound it.
  cavity_.assign(1, place.t);
  bool refused = false, waits = false;
  for (std::size_t n = 0; n < cavity_.size(); ++n) {
    const PlaneTriangle& t = triangulation_.triangle(cavity_[n]);
    for (int i = 0; i < 3; ++i) {
      if (t.n[i] == kNoId || t.side[i] != Side::none) {
        if (!in_circle_about(cavity_[n], i, p)) continue;
        if (t.n[i] == kNoId && request_split(cavity_[n], i)) {
          waits = true;
        } else {
          refused = true;
        }
        continue;
      }
      const PlaneTriangle& g = triangulation_.triangle(t.n[i]);
      if (std::find(cavity_.begin(), cavity_.end(), t.n[i]) != cavity_.end()) continue;
      if (incircle(triangulation_.point(g.v[0]), triangulation_.point(g.v[1]),
                   triangulation_.point(g.v[2]), p) > 0) {
        cavity_.push_back(t.n[i]);
      }
    }
  }
  // Rounding may put p at a vertex. If it is on a segment or side, it is in the circle about it.
  for (const VertexId v : triangulation_.triangle(place.t).v) {
    refused |= triangulation_.point(v) == p;
  }
  if (refused) {
    ++refused_;
  } else if (waits) {
    waiting_.push_back(bad);
  } else {
    ++inserted_;
    enqueue_bad_around(triangulation_.insert_in(place.t, p));
  }
}

}  // namespace deliso
