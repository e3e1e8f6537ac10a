// SPDX-License-Identifier: MIT
#include "isosurface/patch_at.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace deliso {
namespace {

constexpr int kMaxSteps = 8;            // of Newton's method; near Sigma two or three do
constexpr double kLastStep = 1e-7;      // of the distance; the next step is its square
constexpr double kRoundingRoom = 1e-9;  // more than the rounding of a distance, relative
constexpr double kBeyond = std::numeric_limits<double>::infinity();

}  // namespace

PatchAt::PatchAt(const Isosurface& surface, const Vec3& p)
    : PatchAt(surface, p, surface.units().local(p)) {}

PatchAt::PatchAt(const Isosurface& surface, const Vec3& p, const VoxelUnits::Local& at)
    : surface_(surface),
      p_(p),
      patch_(surface.volume().corners(at.voxel, surface.kappa())),
      per_side_(at.per_side),
      u_(at.u) {
  for (int axis = 0; axis < 3; ++axis) {
    room_[axis] = std::min(u_[axis], 1 - u_[axis]);  // negative outside of the box
    u_[axis] = std::clamp(u_[axis], 0.0, 1.0);
  }
  value_ = patch_.value(u_);
  slope_ = patch_.gradient(u_);
}

std::optional<Hit> PatchAt::nearest(const Vec3& direction, double limit,
                                    SearchCounters& counters) const {
  const auto t = parameter_within(direction, limit);
  if (!t) return surface_.nearest(p_, direction, limit, counters);
  const bool is_hit = std::fabs(*t) <= limit;
  counters.count_search(1, is_hit);
  // The cubic is monotone up to the hit.
  return is_hit ? std::optional(Hit{*t, p_ + *t * direction, dot(gradient(), direction) < 0})
                : std::nullopt;
}

double PatchAt::parameter_along(const Vec3& direction, double limit,
                                SearchCounters& counters) const {
  const double size = length(direction);
  if (!(size > 0) || !std::isfinite(size)) return kBeyond;
  const auto hit = nearest(direction / size, limit, counters);
  return hit ? hit->t : kBeyond;
}

// Returns nothing unless the voxel holds all points of the line that are as near as the one of
// Sigma, and the cubic is monotone on them: then there is just that one. Or it holds all points
// within the limit, and they are too few for the cubic to become 0.
std::optional<double> PatchAt::parameter_within(const Vec3& direction, double limit) const {
  const Vec3 w = times(direction, per_side_);
  const TrilinearPatch::Cubic f = patch_.along(u_, value_, slope_, w);
  const auto holds = [&](double d) {
    return std::fabs(w.x) * d < room_.x && std::fabs(w.y) * d < room_.y &&
           std::fabs(w.z) * d < room_.z;
  };
  const double d1 = std::fabs(f.c1), d2 = std::fabs(f.c2), d3 = std::fabs(f.c3);
  const double all = (1 + kRoundingRoom) * limit;
  if (all * (d1 + all * (d2 + all * d3)) < std::fabs(f.c0) && holds(all)) return kBeyond;
  double t = -f.c0 / f.c1;
  for (int n = 0; n < kMaxSteps; ++n) {
    const double d = (1 + kRoundingRoom) * std::fabs(t);
    if (!(holds(d) && (2 * d2 + 3 * d3 * d) * d < d1)) return std::nullopt;
    const double step = f.at(t) / f.slope(t);
    t -= step;
    if (std::fabs(step) <= kLastStep * d) return t;
  }
  return std::nullopt;
}

}  // namespace deliso
