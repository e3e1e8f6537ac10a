// SPDX-License-Identifier: MIT
// A rounding of points to floats that avoids faults by place.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/tri_mesh.h"

namespace deliso {

// Returns the largest distance along an axis by which rounding to float moves points of this size:
// half of that between neighboring floats.
double float_rounding(std::span<const Vec3> points);

// Returns the points rounded to floats. Vertices in faults of the nearest floats take others of the
// eight floats around them if that leaves fewer faults. Four rounds over these vertices; none while
// there are more than kMostMended.
inline constexpr std::size_t kMostMended = 256;
std::vector<Vec3> round_without_faults(const std::vector<Vec3>& exact,
                                       std::span<const Triangle> triangles, int threads);

}  // namespace deliso
