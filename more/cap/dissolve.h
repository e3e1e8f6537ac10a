// SPDX-License-Identifier: MIT
// Dissolves regions, for --min-component and --largest with a solid. Every component of the surface
// separates the box into two sides. So the regions of inside and of outside form a tree, whose
// edges are the components. A region bounded by one component alone is dissolved into the region
// across it, together with the component, if the component is not chosen. So a blob is removed, a
// cavity filled, and the rest separates inside from outside again. The smallest regions are
// dissolved first; of the last two, the one with fewer samples.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "contour/contour.h"

namespace deliso {

struct Dissolved {
  std::vector<std::uint8_t> kept;     // per component of T
  std::array<bool, 8> corner_inside;  // of the box; corner m is at the high end of axis k where bit
                                      // k of m is set
};

// Returns the components to keep. Chosen components are kept. A component is also kept if one of
// its regions spans choice.min_voxels voxels along some axis, or is bounded by other kept
// components.
Dissolved dissolve_others(const Volume& volume, double kappa, const ComponentChoice& choice);

}  // namespace deliso
