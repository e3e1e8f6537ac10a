// SPDX-License-Identifier: MIT
#include "deliso/surface_point.h"

#include <cmath>

#include "base/triangle.h"

namespace deliso {

std::optional<Vec3> SurfacePointFinder::find(const Vec3& a, const Vec3& b, const Vec3& c,
                                             SearchCounters& counters) {
  const Vec3 area = area_normal(a, b, c);
  const double twice_area = length(area);
  if (!(twice_area > 0)) return std::nullopt;
  const Vec3 normal = area / twice_area, center = circumcenter(a, b, c);
  return this->nearest(center, normal, distance(center, a), counters);
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

}  // namespace deliso
