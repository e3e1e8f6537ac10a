// SPDX-License-Identifier: MIT
#include "check/patch_at.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace deliso {
namespace {

constexpr int kMaxSteps = 8;            // of Newton's method; near Sigma two or three do
constexpr double kLastStep = 1e-7;      // of the distance; the next step is its square
constexpr double kRoundingRoom = 1e-9;  // more than the rounding of a distance, relative

}  // namespace

PatchAt::PatchAt(const Isosurface& surface, const Vec3& p) : surface_(surface), p_(p) {
  const Volume& volume = surface.volume();
  const Index3 voxel = volume.voxel_at(p);
  Corners c = volume.corners(voxel);
  for (double& value : c) value -= surface.kappa();
  Vec3 u;
  for (int axis = 0; axis < 3; ++axis) {
    per_spacing_[axis] = 1 / volume.spacing()[axis];
    u[axis] = volume.in_samples(p, axis) - voxel[axis];
    room_[axis] = std::min(u[axis], 1 - u[axis]);  // negative outside of the box
    u[axis] = std::clamp(u[axis], 0.0, 1.0);
  }
  // Differences along x, then values on the voxel's four edges along x, named by y and z.
  const double d00 = c[1] - c[0], d10 = c[3] - c[2], d01 = c[5] - c[4], d11 = c[7] - c[6];
  const double v00 = c[0] + u.x * d00, v10 = c[2] + u.x * d10, v01 = c[4] + u.x * d01,
               v11 = c[6] + u.x * d11;
  const double y0 = v10 - v00, y1 = v11 - v01, xy0 = d10 - d00, xy1 = d11 - d01;
  const double x0 = d00 + u.y * xy0, x1 = d01 + u.y * xy1;
  third_ = xy1 - xy0;
  twist_ = {y1 - y0, x1 - x0, xy0 + u.z * third_};
  slope_ = {x0 + u.z * twist_.y, y0 + u.z * twist_.x, v01 + u.y * y1 - (v00 + u.y * y0)};
  value_ = v00 + u.y * y0 + u.z * slope_.z;
}

double PatchAt::distance_along(const Vec3& direction, double limit,
                               SearchCounters& counters) const {
  constexpr double kBeyond = std::numeric_limits<double>::infinity();
  const double size = length(direction);
  if (!(size > 0) || !std::isfinite(size)) return kBeyond;
  const Vec3 unit = direction / size;
  if (const auto d = distance_within(unit)) return *d <= limit ? *d : kBeyond;
  const auto hit = surface_.nearest(p_, unit, limit, counters);
  return hit ? std::fabs(hit->t) : kBeyond;
}

// Returns nothing unless the voxel holds all points of the line that are as near as the one of
// Sigma, and the cubic is monotone on them: then there is just that one.
std::optional<double> PatchAt::distance_within(const Vec3& direction) const {
  const Vec3 w = times(direction, per_spacing_);
  const double c1 = dot(slope_, w), c3 = third_ * w.x * w.y * w.z;
  const double c2 = twist_.x * w.y * w.z + twist_.y * w.z * w.x + twist_.z * w.x * w.y;
  double t = -value_ / c1;
  for (int n = 0; n < kMaxSteps; ++n) {
    const double d = (1 + kRoundingRoom) * std::fabs(t);
    if (!(std::fabs(w.x) * d < room_.x && std::fabs(w.y) * d < room_.y &&
          std::fabs(w.z) * d < room_.z &&
          (2 * std::fabs(c2) + 3 * std::fabs(c3) * d) * d < std::fabs(c1))) {
      return std::nullopt;
    }
    const double step = (value_ + t * (c1 + t * (c2 + t * c3))) / (c1 + t * (2 * c2 + t * 3 * c3));
    t -= step;
    if (std::fabs(step) <= kLastStep * d) return std::fabs(t);
  }
  return std::nullopt;
}

}  // namespace deliso
