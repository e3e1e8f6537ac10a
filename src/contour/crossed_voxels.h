// SPDX-License-Identifier: MIT
// Where T crosses itself. Triangles of different voxels do not cross: each lies in its own voxel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contour/contour.h"

namespace deliso {

// Returns those of the voxels in which triangles of T cross, by exact predicates; ascending. Only
// `crowded` voxels are asked. `among`: ascending; empty: all of them.
std::vector<std::uint64_t> crossed_voxels(const ContourMesh& contour,
                                          std::span<const std::uint64_t> among);

}  // namespace deliso
