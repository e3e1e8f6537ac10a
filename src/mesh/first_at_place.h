// SPDX-License-Identifier: MIT
// Points at one position.
#pragma once

#include <span>
#include <vector>

#include "base/ids.h"
#include "base/vec3.h"

namespace deliso {

// Returns for each point the first one at its position. Coordinates are compared by their bits, so
// that NaNs have positions too; -0 counts as 0. O(n).
std::vector<VertexId> first_at_place(std::span<const Vec3> points);

}  // namespace deliso
