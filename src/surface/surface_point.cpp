// SPDX-License-Identifier: MIT
#include "surface/surface_point.h"

#include <algorithm>
#include <cmath>

#include "base/triangle.h"

namespace deliso {
namespace {

// Largest h/r at which a surface point is accepted without a test that it lies on the facet's own
// sheet.
constexpr double kMaxTrustedHOverR = 0.3;

// Hits within this share of a chord's length from its end count as the end.
constexpr double kChordEndShare = 0.02;

// leads_to(): the distance of points on the chord, in the shortest spacing of samples, and the
// largest distance of their feet, in that distance. A chord as short as one such distance is not
// tested: no sheet comes between.
constexpr double kStepSpacings = 0.125;
constexpr double kMaxFootSteps = 3;
constexpr double kMaxSteps = 32;  // of a chord; spacings may be very unlike

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
  // Far from the circumcenter x may lie on another sheet that faces as the facet does. Then a sheet
  // between the two faces the opposite way.
  const auto sees = [&](const Vec3& v) { return on_one_sheet(v, *x, normal, counters); };
  return sees(a) && sees(b) && sees(c) ? x : std::nullopt;
}

bool SurfacePointFinder::on_one_sheet(const Vec3& p, const Vec3& q, const Vec3& normal,
                                      SearchCounters& counters) {
  surface_.intersect({p, q}, hits_, counters);
  return std::none_of(hits_.begin(), hits_.end(), [&](const Hit& hit) {
    return hit.t >= kChordEndShare && hit.t <= 1 - kChordEndShare &&
           !faces_along(hit.point, normal);
  });
}

bool SurfacePointFinder::leads_to(const Vec3& p, const Vec3& q, const Vec3& normal,
                                  SearchCounters& counters) {
  const Vec3 spacing = surface_.volume().spacing();
  const double shortest = std::min({spacing.x, spacing.y, spacing.z}), chord = distance(p, q);
  const double steps = std::clamp(std::ceil(chord / (kStepSpacings * shortest)), 1.0, kMaxSteps);
  const double farthest = kMaxFootSteps * chord / steps;
  Vec3 last = p;
  for (double n = 1; n < steps; ++n) {
    const auto foot = this->foot(p + n / steps * (q - p), normal, chord, counters);
    if (!foot || distance(last, *foot) > farthest) return false;
    last = *foot;
  }
  return distance(last, q) <= farthest;
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
