// SPDX-License-Identifier: MIT
// Which facets of a mesh may be replaced: all, or those of one region (refine/regions.h).
#pragma once

#include <limits>

#include "base/ids.h"
#include "base/vec3.h"

namespace deliso {

// Facets below `first_free` are frozen; the others may be replaced by facets within the box, which
// is half open.
struct Region {
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  FaceId first_free = 0;
  Vec3 lo{-kFar, -kFar, -kFar}, hi{kFar, kFar, kFar};

  bool holds(const Vec3& p) const {
    return lo.x <= p.x && p.x < hi.x && lo.y <= p.y && p.y < hi.y && lo.z <= p.z && p.z < hi.z;
  }
  // True if the box holds all that is no further than `radius` from p.
  bool holds(const Vec3& p, double radius) const {
    const Vec3 r{radius, radius, radius};
    return holds(p - r) && holds(p + r);
  }
};

}  // namespace deliso
