// SPDX-License-Identifier: MIT
#include "contour/voxel_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace deliso {
namespace {

// A share of the search interval. A Newton step this small leaves its square as error: nothing.
constexpr double kLastStep = 1e-8;
// Voxels. If Newton's method goes further than this, other lines may have a nearer hit.
constexpr double kMaxNewtonVoxels = 0.5;

// Voxels. Points are first sought at this distance from the voxel's faces. If a face's saddle is at
// kappa, it may be the surface's nearest point for both loops at the face. Vertices of T there
// would be 1e-9 apart.
constexpr double kClearanceVoxels = 1e-3;

// Voxels. All points keep this distance from the voxel's faces, so that none rounds onto the
// volume's box. It moves them off Sigma by less than this share of the corners' range.
constexpr double kMarginVoxels = 1e-11;

// Returns the largest t at which from + t * direction lies in the unit cube, `clearance` from its
// faces.
double exit_parameter(const Vec3& from, const Vec3& direction, double clearance) {
  double limit = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double d = direction[axis];
    if (d > 0) limit = std::min(limit, (1 - clearance - from[axis]) / d);
    if (d < 0) limit = std::min(limit, (clearance - from[axis]) / d);
  }
  return limit;
}

Vec3 corner(int m) {
  return {static_cast<double>(m & 1), static_cast<double>(m >> 1 & 1), static_cast<double>(m >> 2)};
}

Vec3 clamp_to_inside(const Vec3& u, double clearance = kMarginVoxels) {
  const double low = clearance, high = 1 - clearance;
  return {std::clamp(u.x, low, high), std::clamp(u.y, low, high), std::clamp(u.z, low, high)};
}

}  // namespace

std::optional<double> VoxelPatch::newton(const Cubic& f, double limit) {
  double t = 0;
  for (int step = 0; step < 6; ++step) {
    const double next = t - f.at(t) / f.slope(t);
    if (!(next > 0 && next <= limit)) return std::nullopt;
    if (std::abs(next - t) <= kLastStep * limit) return next;
    t = next;
  }
  return std::nullopt;
}

double VoxelPatch::first_sign_change(const Cubic& f, double limit) {
  const bool positive = f.c0 >= 0;
  if ((f.at(limit) >= 0) == positive) return -1;
  // Newton's method in a bracket whose ends have different signs. Bisects when a step leaves the
  // bracket, and at every eighth step.
  double low = 0, high = limit, t = -f.c0 / f.c1;
  for (int step = 0; step < 100; ++step) {
    if (!(t > low && t < high)) t = low + 0.5 * (high - low);
    const double v = f.at(t);
    if (v == 0 || t <= low || t >= high) break;
    ((v >= 0) == positive ? low : high) = t;
    const double newton = t - v / f.slope(t);
    const bool converged = std::abs(newton - t) <= kLastStep * limit;
    t = step % 8 == 7 && !converged ? low + 0.5 * (high - low) : newton;
    if (converged) break;
  }
  return std::clamp(t, low, high);
}

Vec3 VoxelPatch::surface_point_near(const Vec3& from) const {
  // A piece around a sample next to kappa may have no point at this clearance.
  const auto [least, most] =
      std::minmax_element(corners_.begin(), corners_.end(),
                          [](double a, double b) { return std::abs(a) < std::abs(b); });
  const Vec3 clear = clamp_to_inside(from, kClearanceVoxels);
  if (from == clear || std::abs(*least) > kClearanceVoxels * std::abs(*most)) {
    if (const auto p = surface_point_within(clear, kClearanceVoxels)) return *p;
  }
  if (const auto p = surface_point_within(from, 0)) return *p;
  // No line hit: a corner equals kappa, up to rounding, and Sigma only touches the voxel there.
  double smallest = std::numeric_limits<double>::infinity();
  Vec3 touching = from;
  const bool positive = value(from) >= 0;
  for (int m = 0; m < 8; ++m) {
    if ((corners_[m] >= 0) == positive || !(std::abs(corners_[m]) < smallest)) continue;
    smallest = std::abs(corners_[m]);
    touching = corner(m);
  }
  return clamp_to_inside(touching);
}

std::optional<Vec3> VoxelPatch::surface_point_within(const Vec3& from, double clearance) const {
  const double v = value(from);
  if (v == 0) return clamp_to_inside(from);
  const Vec3 g = gradient(from);
  const Vec3 towards = v > 0 ? -g : g;
  if (const auto t = newton(along(from, v, g, towards), kMaxNewtonVoxels / length(g))) {
    const Vec3 p = from + *t * towards;
    if (p == clamp_to_inside(p, std::max(clearance, kMarginVoxels))) return p;
  }
  double nearest = std::numeric_limits<double>::infinity();
  std::optional<Vec3> found;
  const auto search = [&](const Vec3& direction) {
    const double limit = exit_parameter(from, direction, clearance);
    if (!(limit > 0) || limit == std::numeric_limits<double>::infinity()) return;
    const double t = first_sign_change(along(from, v, g, direction), limit);
    const double d2 = t * t * length2(direction);
    if (t < 0 || !(d2 < nearest)) return;
    nearest = d2;
    found = clamp_to_inside(from + t * direction);
  };
  search(towards);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 direction;
      direction[axis] = side;
      search(direction);
    }
  }
  for (int m = 0; m < 8; ++m) {
    if ((corners_[m] >= 0) != (v >= 0)) search(corner(m) - from);
  }
  return found;
}

}  // namespace deliso
