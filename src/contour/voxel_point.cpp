// SPDX-License-Identifier: MIT
#include "contour/voxel_point.h"

#include <algorithm>
#include <limits>

namespace deliso {
namespace {

constexpr double kFar = 0.5;  // a hit further away, in voxels, is worth a look for a nearer one

// Largest t for which from + t * direction stays in the unit cube.
double exit_parameter(const Vec3& from, const Vec3& direction) {
  double limit = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double d = direction[axis];
    if (d > 0) limit = std::min(limit, (1 - from[axis]) / d);
    if (d < 0) limit = std::min(limit, -from[axis] / d);
  }
  return limit;
}

Vec3 clamp_to_cube(const Vec3& u) {
  return {std::clamp(u.x, 0.0, 1.0), std::clamp(u.y, 0.0, 1.0), std::clamp(u.z, 0.0, 1.0)};
}

}  // namespace

TrilinearPatch::TrilinearPatch(const Corners& c) : corners_(c) {
  k_[0] = c[0];
  k_[1] = c[1] - c[0];
  k_[2] = c[2] - c[0];
  k_[4] = c[4] - c[0];
  k_[3] = (c[3] - c[2]) - k_[1];
  k_[5] = (c[5] - c[4]) - k_[1];
  k_[6] = (c[6] - c[4]) - k_[2];
  k_[7] = ((c[7] - c[6]) - (c[5] - c[4])) - k_[3];
}

double TrilinearPatch::value(const Vec3& u) const {
  return (k_[0] + k_[1] * u.x + u.y * (k_[2] + k_[3] * u.x)) +
         u.z * (k_[4] + k_[5] * u.x + u.y * (k_[6] + k_[7] * u.x));
}

Vec3 TrilinearPatch::gradient(const Vec3& u) const {
  return {k_[1] + k_[3] * u.y + u.z * (k_[5] + k_[7] * u.y),
          k_[2] + k_[3] * u.x + u.z * (k_[6] + k_[7] * u.x),
          k_[4] + k_[5] * u.x + u.y * (k_[6] + k_[7] * u.x)};
}

double TrilinearPatch::hit(const Vec3& from, double value, const Vec3& d, double limit) const {
  const Vec3 g = gradient(from);
  const double c1 = dot(g, d);
  const double c2 = (k_[3] + k_[7] * from.z) * d.x * d.y + (k_[5] + k_[7] * from.y) * d.x * d.z +
                    (k_[6] + k_[7] * from.x) * d.y * d.z;
  const double c3 = k_[7] * d.x * d.y * d.z;
  const auto at = [&](double t) { return value + t * (c1 + t * (c2 + t * c3)); };
  const bool positive = value >= 0;
  if ((at(limit) >= 0) == positive) return -1;
  // Newton's method, kept within a bracket whose ends have different signs; bisection where it
  // would leave it or gains too little.
  double low = 0, high = limit, t = -value / c1;
  for (int step = 0; step < 100; ++step) {
    if (!(t > low && t < high)) t = low + 0.5 * (high - low);
    const double v = at(t);
    if (v == 0 || t <= low || t >= high) break;
    ((v >= 0) == positive ? low : high) = t;
    const double newton = t - v / (c1 + t * (2 * c2 + t * 3 * c3));
    const bool settled = std::abs(newton - t) <= 1e-15 * limit;
    t = step % 8 == 7 && !settled ? low + 0.5 * (high - low) : newton;
    if (settled) break;
  }
  return std::clamp(t, low, high);
}

Vec3 TrilinearPatch::surface_point_near(const Vec3& from) const {
  const double v = value(from);
  if (v == 0) return from;
  const Vec3 g = gradient(from);
  double nearest = std::numeric_limits<double>::infinity();
  Vec3 found = from;
  const auto search = [&](const Vec3& direction, double limit) {
    if (!(limit > 0) || limit == std::numeric_limits<double>::infinity()) return;
    const double t = hit(from, v, direction, limit);
    const double d2 = t * t * length2(direction);
    if (t < 0 || !(d2 < nearest)) return;
    nearest = d2;
    found = clamp_to_cube(from + t * direction);
  };
  const Vec3 downhill = v > 0 ? -g : g;
  search(downhill, exit_parameter(from, downhill));
  if (nearest <= kFar * kFar) return found;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 direction;
      direction[axis] = side;
      search(direction, exit_parameter(from, direction));
    }
  }
  double smallest = std::numeric_limits<double>::infinity();
  Vec3 touching = from;
  for (int m = 0; m < 8; ++m) {
    if ((corners_[m] >= 0) == (v >= 0)) continue;
    const Vec3 corner{static_cast<double>(m & 1), static_cast<double>(m >> 1 & 1),
                      static_cast<double>(m >> 2)};
    search(corner - from, 1);
    if (std::abs(corners_[m]) < smallest) {
      smallest = std::abs(corners_[m]);
      touching = corner;
    }
  }
  // No line hit: a corner equals kappa, up to rounding, and Sigma only touches the voxel there.
  if (nearest == std::numeric_limits<double>::infinity()) return touching;
  return found;
}

}  // namespace deliso
