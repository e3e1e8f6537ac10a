// SPDX-License-Identifier: MIT
// Points of Sigma on the box, where the interpolant is bilinear.
#pragma once

#include <optional>

#include "base/box3.h"
#include "volume/volume.h"

namespace deliso {

// The point of Sigma on box face `face` halfway between two of its points a and b there: where the
// in-face normal line of the chord ab, through its midpoint, meets Sigma nearest to the midpoint,
// at most half the chord's length away. Its coordinate across the face is the box's to the last
// bit. Between two points of one arc within a pixel there always is one: the arc is a convex,
// monotone piece of a hyperbola. Points are in the scaled frame.
std::optional<Vec3> boundary_midpoint(const Volume& volume, double kappa, BoxFace face,
                                      const Vec3& a, const Vec3& b);

}  // namespace deliso
