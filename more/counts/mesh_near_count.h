// SPDX-License-Identifier: MIT
// A mesh with a few more vertices or triangles than desired: the bound on the distance that gives
// as many is searched for, block by block. more/counts/merge_vertices.h takes it down to the
// number.
#pragma once

#include "blocks/mesh_in_blocks.h"

namespace deliso {

// Returns the mesh of {g = kappa}, as mesh_in_blocks() does of the whole, but at another bound on
// the distance: the one that leaves 1.3 to 2 times as many vertices or triangles as run.options
// desires, if there is one. It keeps all reference samples, and max_vertices does not count.
Block mesh_near_count(const RunInput& run, std::vector<std::uint8_t> kept);

}  // namespace deliso
