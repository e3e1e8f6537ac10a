// SPDX-License-Identifier: MIT
// Leaves components out of T (--largest, --min-component). All later steps take T for the whole
// surface: sites, labels, boundary curves, and the samples of Stage 2.
#pragma once

#include <cstdint>
#include <span>

#include "contour/contour.h"

namespace deliso {

// Removes the components with kept[c] == 0 from T, and numbers the others anew. Their vertices,
// triangles and chains stay in order. I1 to I6 hold; `summary.active_voxels` and the like still
// count voxels of the whole surface.
void keep_components(ContourMesh& contour, std::span<const std::uint8_t> kept);

}  // namespace deliso
