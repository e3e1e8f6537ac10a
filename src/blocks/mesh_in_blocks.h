// SPDX-License-Identifier: MIT
// The one division: a volume is cut into blocks, each is meshed by itself, and the meshes are
// welded. Only here do the stages meet threads. What is global happens before the blocks or after
// them: chosen components, desired counts, the report's sums.
#pragma once

#include <cstdint>
#include <vector>

#include "blocks/block.h"
#include "blocks/weld.h"

namespace deliso {

// Returns the mesh of {g = kappa}, refined at the seams, without caps. With a desired count it has
// more vertices or triangles than desired, and all reference samples. `kept`: per component of the
// whole contour, nonzero if it is kept; empty: options.components decides. Throws InputError beyond
// --max-vertices.
WeldedMesh mesh_in_blocks(const Volume& volume, double kappa, const Options& options,
                          const Parameters& parameters, std::vector<std::uint8_t> kept,
                          Report& report);

}  // namespace deliso
