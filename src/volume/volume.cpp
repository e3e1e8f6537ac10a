// SPDX-License-Identifier: MIT
#include "volume/volume.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/text.h"

namespace deliso {
namespace {

struct Local {
  Index3 voxel;
  Vec3 u;  // coordinates in the voxel, each in [0, 1]
};

Local localize(const Volume& volume, const Vec3& p) {
  Local local{volume.voxel_at(p), {}};
  for (int axis = 0; axis < 3; ++axis) {
    const double u = volume.in_samples(p, axis) - local.voxel[axis];
    local.u[axis] = std::clamp(u, 0.0, 1.0);
  }
  return local;
}

}  // namespace

void require_in_range(Index3 dims, const Vec3& spacing, const Frame& frame, std::string_view name) {
  for (int axis = 0; axis < 3; ++axis) {
    const double s = spacing[axis];
    const std::string_view along =
        std::string_view("xyz").substr(static_cast<std::size_t>(axis), 1);
    if (dims[axis] < 1) {
      throw InputError(name, ": has ", dims[axis], " samples along ", along);
    }
    if (!(s >= kSmallestSpacing && s * dims[axis] <= kLargestLength)) {
      throw InputError(name, ": spacing ", s, " along ", along, " is out of range (from ",
                       kSmallestSpacing, ", and to a box of ", kLargestLength, ")");
    }
  }
  if (!in_range(frame.origin)) {
    throw InputError(name, ": its origin is further than ", kLargestLength, " away");
  }
  for (const Vec3& axis : frame.axes) {
    constexpr double kTolerance = 1e-6;
    if (!(std::fabs(length(axis) - 1) <= kTolerance)) {
      throw InputError(name, ": an axis of its frame is no unit vector");
    }
  }
}

Volume::Volume(Index3 dims, Vec3 spacing, SampleType type, const std::byte* bytes,
               std::shared_ptr<const void> owner, Frame frame)
    : dims_(dims),
      spacing_(spacing),
      type_(type),
      bytes_(bytes),
      owner_(std::move(owner)),
      frame_(frame),
      whole_(dims) {
  require_in_range(dims, spacing, frame, "volume");
}

Volume Volume::with_samples(SampleType type, const std::byte* bytes,
                            std::shared_ptr<const void> owner) const {
  Volume other = *this;
  other.type_ = type;
  other.bytes_ = bytes;
  other.owner_ = std::move(owner);
  return other;
}

Volume Volume::as_block(Index3 first, Index3 whole) const {
  require_in_range(whole, spacing_, frame_, "volume");
  Volume block = *this;
  block.first_ = first;
  block.whole_ = whole;
  return block;
}

unsigned Volume::inner_faces() const {
  unsigned faces = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (first_[axis] > 0) faces |= 1u << (2 * axis);
    if (first_[axis] + dims_[axis] < whole_[axis]) faces |= 2u << (2 * axis);
  }
  return faces;
}

double Volume::voxel() const {
  const auto [x, y, z] = spacing_;
  if (x == y && y == z) return x;
  // Newton's method from above, the same bits on every machine, which cbrt() need not give.
  double side = std::max({x, y, z});
  for (;;) {
    const double next = (2 * side + x / side * y / side * z) / 3;
    if (!(next < side)) return side;
    side = next;
  }
}

Box3 Volume::box() const {
  return {position({0, 0, 0}), position(voxels())};
}

Index3 Volume::voxel_at(const Vec3& p) const {
  Index3 voxel;
  for (int axis = 0; axis < 3; ++axis) {
    const double u = in_samples(p, axis);
    const int last = std::max(dims_[axis] - 2, 0);
    voxel[axis] = u > 0 ? static_cast<int>(std::min(u, static_cast<double>(last))) : 0;
  }
  return voxel;
}

Corners Volume::corners(Index3 voxel, double kappa) const {
  const std::size_t n = index(voxel.i, voxel.j, voxel.k);
  const std::size_t dy = dims_.i, dz = dy * dims_.j;
  return visit([=](const auto* s) { return corners_from(s + n, dy, dz, kappa); });
}

double Volume::value(const Vec3& p) const {
  const Local at = localize(*this, p);
  return interpolated(corners(at.voxel), at.u.x, at.u.y, at.u.z);
}

Vec3 Volume::gradient(const Vec3& p) const {
  const Local at = localize(*this, p);
  const Corners c = corners(at.voxel);
  const Vec3 u = at.u;
  const auto mix = [](double a, double b, double t) { return a + t * (b - a); };
  const double gx =
      mix(mix(c[1] - c[0], c[3] - c[2], u.y), mix(c[5] - c[4], c[7] - c[6], u.y), u.z);
  const double gy =
      mix(mix(c[2] - c[0], c[3] - c[1], u.x), mix(c[6] - c[4], c[7] - c[5], u.x), u.z);
  const double gz =
      mix(mix(c[4] - c[0], c[5] - c[1], u.x), mix(c[6] - c[2], c[7] - c[3], u.x), u.y);
  return {gx / spacing_.x, gy / spacing_.y, gz / spacing_.z};
}

}  // namespace deliso
