// SPDX-License-Identifier: MIT
// The part of a mesh that may change.
#pragma once

#include <limits>

#include "base/ids.h"
#include "volume/volume.h"

namespace deliso {

// Facets before `first_free` are frozen. The others may be replaced, by facets in the box from `lo`
// (included) to `hi` (excluded).
struct FreeBox {
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  FaceId first_free = 0;
  Vec3 lo{-kFar, -kFar, -kFar}, hi{kFar, kFar, kFar};

  // Returns the box of a block: without its inner faces, which the neighbors share.
  static FreeBox within(const Volume& block);

  bool holds(const Vec3& p) const {
    return lo.x <= p.x && p.x < hi.x && lo.y <= p.y && p.y < hi.y && lo.z <= p.z && p.z < hi.z;
  }
  // True if the box holds the ball around p.
  bool holds(const Vec3& p, double radius) const {
    const Vec3 r{radius, radius, radius};
    return holds(p - r) && holds(p + r);
  }
};

}  // namespace deliso
