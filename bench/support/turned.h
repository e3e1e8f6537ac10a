// SPDX-License-Identifier: MIT
// A volume turned by quarter turns. Its surface is turned too, and what a mesh of it is worth
// should stay; but all that depends on the order of samples, voxels and blocks is another.
#pragma once

#include <cstdint>

#include "volume/volume.h"

namespace deliso {

inline constexpr std::uint64_t kTurns = 24;  // of a cube onto itself

// Returns the volume after turn `n`, below kTurns. Turn 0 leaves it as it is, turns 1 and 2
// exchange its axes in a cycle. pre: the volume is whole, and has no frame.
Volume turned(const Volume& volume, std::uint64_t n);

}  // namespace deliso
