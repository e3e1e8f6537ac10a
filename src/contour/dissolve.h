// SPDX-License-Identifier: MIT
// What --min-component and --largest mean for a solid. Every component of the surface parts the box
// into two sides, so what it parts, the regions of inside and of outside, hang together by the
// components as a tree. A region that one component alone bounds is dissolved into the one beyond,
// component and all, where both are smaller than asked for: a blob goes, a cavity is filled. What
// is left parts inside from outside again. The smallest regions go first; of the last two the one
// with fewer samples.
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

// Chosen components are kept, and so are those whose regions are bounded by others that are kept,
// or are as large as choice.min_voxels along some axis. `contour` is that of the volume at kappa.
Dissolved dissolve_others(const ContourMesh& contour, const Volume& volume, double kappa,
                          const ComponentChoice& choice);

}  // namespace deliso
