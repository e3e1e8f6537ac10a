// SPDX-License-Identifier: MIT
#include "surface/surface_point.h"

#include <algorithm>
#include <cmath>

#include "base/triangle.h"

namespace deliso {
namespace {

// Up to this h/r a surface point is that of the facet's own sheet.
constexpr double kUndoubted = 0.3;

// What counts as an end of a chord between two points of Sigma, as a share of it.
constexpr double kEnd = 0.02;

}  // namespace

std::optional<Vec3> SurfacePointFinder::find(const Vec3& a, const Vec3& b, const Vec3& c,
                                             SearchCounters& counters) {
  const Vec3 area = area_normal(a, b, c);
  const double twice_area = length(area);
  if (!(twice_area > 0)) return std::nullopt;
  const Vec3 normal = area / twice_area, center = circumcenter(a, b, c);
  // Across a needle the circumradius says nothing: the center is far away, and so would be x.
  const double longest2 = std::max({distance2(a, b), distance2(b, c), distance2(c, a)});
  const double limit = std::min(distance(center, a), std::sqrt(longest2));
  const auto x = this->nearest(center, normal, limit, counters);
  if (!x || distance(*x, center) <= kUndoubted * distance(center, a)) return x;
  // Far from the circumcenter it may lie on another sheet that faces the same way. Between the two
  // there is one that faces the other way.
  const auto sees = [&](const Vec3& v) { return on_one_sheet(v, *x, normal, counters); };
  return sees(a) && sees(b) && sees(c) ? x : std::nullopt;
}

bool SurfacePointFinder::on_one_sheet(const Vec3& p, const Vec3& q, const Vec3& normal,
                                      SearchCounters& counters) {
  surface_.intersect({p, q}, hits_, counters);
  return std::none_of(hits_.begin(), hits_.end(), [&](const Hit& hit) {
    return hit.t >= kEnd && hit.t <= 1 - kEnd && !faces_along(hit.point, normal);
  });
}

std::optional<Vec3> SurfacePointFinder::nearest(const Vec3& center, const Vec3& normal,
                                                double limit, SearchCounters& counters) {
  const auto first = surface_.nearest(center, normal, limit, counters);
  if (!first) return std::nullopt;
  if (faces_along(first->point, normal)) return first->point;
  // Rare: look at all of the line within the limit.
  const Segment chord{center - limit * normal, center + limit * normal};
  surface_.intersect(chord, hits_, counters);
  const Hit* best = nullptr;
  for (const Hit& hit : hits_) {
    if (!faces_along(hit.point, normal)) continue;
    if (!best || std::abs(hit.t - 0.5) < std::abs(best->t - 0.5)) best = &hit;
  }
  return best ? std::optional(best->point) : std::nullopt;
}

std::optional<Vec3> SurfacePointFinder::foot(const Vec3& from, const Vec3& normal, double limit,
                                             SearchCounters& counters) {
  const Vec3 gradient = surface_.gradient(from);
  const double steepness = length(gradient);
  if (!(steepness > 0)) return std::nullopt;
  const auto x = this->nearest(from, (-1 / steepness) * gradient, limit, counters);
  return x && faces_along(*x, normal) ? x : std::nullopt;
}

}  // namespace deliso
