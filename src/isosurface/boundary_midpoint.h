// SPDX-License-Identifier: MIT
// Points of Sigma on the box, where the interpolant is bilinear.
#pragma once

#include <optional>

#include "base/box3.h"
#include "volume/volume.h"

namespace deliso {

// Returns the point of Sigma on box face `face` halfway between two of its points a and b there.
// That is the nearest hit of the line through the midpoint of the chord ab, in the face and normal
// to the chord. It is at most half the chord's length from the midpoint; nothing if there is none.
// Between two points of one arc within a pixel there is always one, since the arc is a convex,
// monotone piece of a hyperbola. Its coordinate across the face is the box's to the last bit.
// Points are in the scaled frame.
std::optional<Vec3> boundary_midpoint(const Volume& volume, double kappa, BoxFace face,
                                      const Vec3& a, const Vec3& b);

}  // namespace deliso
