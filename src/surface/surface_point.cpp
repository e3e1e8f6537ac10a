// SPDX-License-Identifier: MIT
#include "surface/surface_point.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/triangle.h"

namespace deliso {
namespace {

// Largest h/r at which a surface point is accepted without a test that it lies on the facet's own
// sheet.
constexpr double kMaxTrustedHOverR = 0.3;

}  // namespace

std::optional<Vec3> SurfacePointFinder::find(const Vec3& a, const Vec3& b, const Vec3& c,
                                             SearchCounters& counters) {
  const Vec3 area = area_normal(a, b, c);
  const double twice_area = length(area);
  if (!(twice_area > 0)) return std::nullopt;
  const Vec3 normal = area / twice_area, center = circumcenter(a, b, c);
  // The circumcenter of a needle is far away, and so would x be: the longest edge is a limit too.
  const double limit = std::min(distance(center, a), std::sqrt(longest_edge2(a, b, c)));
  const auto x = nearest(center, normal, limit, counters);
  if (!x || distance(*x, center) <= kMaxTrustedHOverR * distance(center, a)) return x;
  // Far from the circumcenter x may lie on another sheet that faces as the facet does.
  const std::array corners{a, b, c};
  const Vec3& near = *std::ranges::min_element(
      corners, {}, [&](const Vec3& corner) { return distance2(corner, *x); });
  return leads_to(near, *x) ? x : std::nullopt;
}

std::optional<Vec3> SurfacePointFinder::nearest(const PatchAt& from, const Vec3& normal,
                                                double limit, SearchCounters& counters) {
  const auto first = from.nearest(normal, limit, counters);
  if (!first) return std::nullopt;
  if (first->leaves) return first->point;
  // Rare: search all of the line within the limit.
  const Vec3& center = from.point();
  surface_.intersect({center - limit * normal, center + limit * normal}, hits_, counters);
  const Hit* best = nullptr;
  for (const Hit& hit : hits_) {
    if (!hit.leaves) continue;
    if (!best || std::abs(hit.t - 0.5) < std::abs(best->t - 0.5)) best = &hit;
  }
  return best ? std::optional(best->point) : std::nullopt;
}

std::optional<Vec3> SurfacePointFinder::foot(const Vec3& from, const Vec3& normal, double limit,
                                             SearchCounters& counters) {
  const PatchAt patch(surface_, from);
  const Vec3 gradient = patch.gradient();
  const double steepness = length(gradient);
  if (!(steepness > 0)) return std::nullopt;
  const auto x = nearest(patch, (-1 / steepness) * gradient, limit, counters);
  return x && faces_along(*x, normal) ? x : std::nullopt;
}

}  // namespace deliso
