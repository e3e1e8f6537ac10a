// SPDX-License-Identifier: MIT
#include "volume/volume.h"

#include <algorithm>
#include <utility>

#include "base/check.h"

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

Volume::Volume(const Grid& grid, const std::byte* bytes, std::shared_ptr<const void> owner)
    : Grid(grid), bytes_(bytes), owner_(std::move(owner)) {
  DELISO_CHECK(bytes);
}

Corners Volume::corners(Index3 voxel, double kappa) const {
  const std::size_t n = index(voxel.i, voxel.j, voxel.k);
  const std::size_t dy = dims().i, dz = dy * dims().j;
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
  const Vec3 s = sides(at.voxel);
  return {gx / s.x, gy / s.y, gz / s.z};
}

}  // namespace deliso
