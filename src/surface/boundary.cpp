// SPDX-License-Identifier: MIT
#include "surface/boundary.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "isosurface/boundary_midpoint.h"

namespace deliso {

double distance2_to_chord(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2_ab = length2(ab);
  const double t = length2_ab > 0 ? std::clamp(dot(p - a, ab) / length2_ab, 0.0, 1.0) : 0.0;
  return distance2(p, a + t * ab);
}

const Vec3& BoundaryCurves::point(CurvePlace place) const {
  return loop(place.loop)[static_cast<std::size_t>(place.s)].point;
}

bool BoundaryCurves::is_kept(CurvePlace place) const {
  return place.s == std::floor(place.s) &&
         loop(place.loop)[static_cast<std::size_t>(place.s)].is_kept;
}

bool is_on_fixed(const BoundaryLoop& loop, double s) {
  const auto at = static_cast<std::size_t>(s);
  if (loop[at].is_fixed) return true;
  const std::size_t n = loop.size();
  return s == static_cast<double>(at) && loop[(at + n - 1) % n].is_fixed;
}

bool BoundaryCurves::runs_beside_fixed(const CurvePoint& a, const CurvePoint& b) const {
  const Vec3 &p = a.point, &q = b.point;
  const int common = (p.x == q.x) + (p.y == q.y) + (p.z == q.z);
  return common >= 2 && is_on_fixed(a.place) && is_on_fixed(b.place);
}

std::vector<CurvePoint> BoundaryCurves::arc(const CurvePoint& a, const CurvePoint& b) const {
  const auto& [number, start] = a.place;
  const BoundaryLoop& curve = loop(number);
  const std::size_t n = curve.size();
  const double end = b.place.s > start ? b.place.s : b.place.s + static_cast<double>(n);
  std::vector<CurvePoint> points{a};
  for (auto i = static_cast<std::size_t>(start) + 1; static_cast<double>(i) < end; ++i) {
    points.push_back({{number, static_cast<double>(i)}, curve[i % n].point});
  }
  points.push_back({{number, end}, b.point});
  return points;
}

std::optional<Vec3> BoundaryCurves::middle(const CurvePoint& from, const CurvePoint& to) const {
  const BoundaryLoop& curve = loop(from.place.loop);
  const BoxFace face = curve[static_cast<std::size_t>(from.place.s) % curve.size()].face;
  return boundary_midpoint(surface_.volume(), surface_.kappa(), face, from.point, to.point);
}

std::optional<CurvePoint> BoundaryCurves::split(const CurvePoint& a, const CurvePoint& b) const {
  const std::vector<CurvePoint> points = arc(a, b);
  double total = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    total += distance(points[i - 1].point, points[i].point);
  }

  std::optional<CurvePoint> best;
  double best_gap = total;
  const auto consider = [&](const CurvePoint& at, double from_start) {
    const double gap = std::abs(from_start - total / 2);
    if (gap >= best_gap || at.point == a.point || at.point == b.point) return;
    best_gap = gap;
    best = at;
  };
  double so_far = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const CurvePoint &from = points[i - 1], &to = points[i];
    const double size = distance(from.point, to.point);
    const double s = from.place.s + 0.5 * (to.place.s - from.place.s);
    if (so_far <= total / 2 && total / 2 <= so_far + size && from.place.s < s && s < to.place.s) {
      if (const auto p = middle(from, to)) consider({{a.place.loop, s}, *p}, so_far + size / 2);
    }
    so_far += size;
    if (i + 1 < points.size()) consider(to, so_far);
  }
  if (!best) return std::nullopt;
  const auto length = static_cast<double>(loop(a.place.loop).size());
  if (best->place.s >= length) best->place.s -= length;
  return best;
}

bool BoundaryCurves::strays(const CurvePoint& a, const CurvePoint& b, double limit) const {
  const BoundaryLoop& curve = loop(a.place.loop);
  const std::size_t n = curve.size();
  const double end = b.place.s > a.place.s ? b.place.s : b.place.s + static_cast<double>(n);
  for (auto i = static_cast<std::size_t>(a.place.s) + 1; static_cast<double>(i) < end; ++i) {
    if (distance2_to_chord(curve[i % n].point, a.point, b.point) > limit * limit) return true;
  }
  return false;
}

double BoundaryCurves::sagitta(const CurvePoint& a, const CurvePoint& b) const {
  const std::vector<CurvePoint> points = arc(a, b);
  double worst2 = 0;
  const auto consider = [&](const Vec3& p) {
    worst2 = std::max(worst2, distance2_to_chord(p, a.point, b.point));
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    consider(points[i].point);
    if (const auto p = middle(points[i - 1], points[i])) consider(*p);
  }
  return std::sqrt(worst2);
}

void BoundaryChain::add_loop(std::span<const VertexId> vertices,
                             std::span<const CurvePlace> places) {
  const std::size_t n = vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    link(vertices[i]) = {vertices[(i + 1) % n], vertices[(i + n - 1) % n], places[i]};
  }
}

void BoundaryChain::insert_after(VertexId a, VertexId v, CurvePlace place) {
  const VertexId b = links_[a].next;
  link(v) = {b, a, place};
  links_[a].next = v;
  links_[b].previous = v;
}

void BoundaryChain::remove(VertexId v) {
  const Link removed = links_[v];
  links_[removed.previous].next = removed.next;
  links_[removed.next].previous = removed.previous;
  links_[v] = {};
}

BoundaryChain BoundaryChain::renumbered(const std::vector<VertexId>& new_id) const {
  BoundaryChain chain;
  for (VertexId v = 0; v < links_.size(); ++v) {
    if (!is_boundary(v) || new_id[v] == kNoId) continue;
    VertexId after = links_[v].next, before = links_[v].previous;  // ends at v at the latest
    while (new_id[after] == kNoId) after = links_[after].next;
    while (new_id[before] == kNoId) before = links_[before].previous;
    chain.link(new_id[v]) = {new_id[after], new_id[before], links_[v].place};
  }
  return chain;
}

}  // namespace deliso
