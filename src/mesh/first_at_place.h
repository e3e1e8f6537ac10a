// SPDX-License-Identifier: MIT
// Which points are at one position.
#pragma once

#include <span>
#include <vector>

#include "base/ids.h"
#include "base/vec3.h"

namespace deliso {

// Per point the first one at its position. Coordinates are compared by their bits, so that any are
// in order, but for -0, which is 0. O(n log n).
std::vector<VertexId> first_at_place(std::span<const Vec3> points);

}  // namespace deliso
